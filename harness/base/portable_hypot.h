// A hypotenuse that is the same bits everywhere in a portable build (docs/reference/browser.md).
#pragma once

#include <cmath>

namespace cutbench {

/// std::hypot, which each C library rounds in its own way; with CUTBENCH_PORTABLE the root itself, which over- and
/// underflows where the squares do.
inline double portable_hypot(double x, double y) {
#ifdef CUTBENCH_PORTABLE
  return std::sqrt(x * x + y * y);
#else
  return std::hypot(x, y);
#endif
}

}  // namespace cutbench
