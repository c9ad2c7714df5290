// Whether two sheets are the same bit for bit: what a cut that was not made must leave behind.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "harness/mesh/sheet.h"

namespace cutbench {

template <class T>
bool same_bits(const T& a, const T& b) {
  using Bits = std::array<std::uint64_t, sizeof(T) / 8>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

/// The first difference between two sheets, looked at through all that the public interface shows; empty: none.
std::string difference(const Sheet& a, const Sheet& b);

}  // namespace cutbench
