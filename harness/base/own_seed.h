// A seed for each of several things that share one, so that a lucky draw for one of them doesn't tell in all.
#pragma once

#include <cstdint>
#include <string_view>

namespace cutbench {

/// The seed with the name's hash (64-bit FNV-1a: Fowler, Noll and Vo) folded in.
constexpr std::uint64_t own_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return seed ^ hash;
}

}  // namespace cutbench
