// What makes a measurement cold.
#pragma once

#include <cstddef>
#include <vector>

namespace cutbench {

/// Drives what the caches hold out of them, by a pass over 64 MB.
inline void chill_caches() {
  static std::vector<unsigned char> ballast(std::size_t{64} << 20);
  for (std::size_t i = 0; i < ballast.size(); i += 64) ++ballast[i];
}

}  // namespace cutbench
