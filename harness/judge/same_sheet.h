// Whether two sheets are the same bit for bit: what a cut that was not made must leave behind.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>

#include "harness/mesh/sheet.h"

namespace cutbench {

template <class T>
bool same_bits(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0, "no padding");
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// The first difference between two sheets, looked at through all that the public interface shows; empty: none.
std::string difference(const Sheet& a, const Sheet& b);

}  // namespace cutbench
