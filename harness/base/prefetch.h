// Memory that is asked for before it is needed. Short rows end the loops over them at hard to foresee places, and a wrong
// guess stops the processor from reading on by itself.
#pragma once

#include <cstddef>

namespace cutbench {

/// Brings `n` items into the cache while other work goes on.
template <class T>
void prefetch(const T* begin, std::size_t n) {
  constexpr std::size_t line = 64;  // bytes of the cache
  const char* const first = reinterpret_cast<const char*>(begin);
  for (std::size_t byte = 0; byte < n * sizeof(T); byte += line) __builtin_prefetch(first + byte);
}

}  // namespace cutbench
