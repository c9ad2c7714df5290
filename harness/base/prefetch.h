// Memory that is asked for before it is needed. A processor reads ahead by itself, but not past a branch that it
// foresees wrongly, and loops over short rows of different lengths are full of these.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cutbench {

constexpr std::size_t rows_ahead = 4;  ///< of the row at hand: those to be asked for

/// Brings `n` items into the cache while other work goes on.
template <class T>
void prefetch(const T* begin, std::size_t n) {
  constexpr std::size_t line = 64;  // bytes of the cache
  const auto first = reinterpret_cast<std::uintptr_t>(begin), end = first + n * sizeof(T);
  for (std::uintptr_t at = first / line * line; at < end; at += line)
    __builtin_prefetch(reinterpret_cast<const void*>(at));
}

}  // namespace cutbench
