// Random numbers that are the same on every machine, unlike the distributions of <random>.
#pragma once

#include <cmath>
#include <cstdint>

#include "harness/base/conversions.h"
#include "harness/base/points.h"

namespace cutbench {

/// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  double unit() { return to_double(bits() >> 11) * 0x1p-53; }  ///< uniform in [0, 1)
  double between(double a, double b) { return a + (b - a) * unit(); }
  bool coin(double p = 0.5) { return unit() < p; }
  /// 0 ... n-1. \pre n > 0
  std::size_t below(std::size_t n) { return to_size(bits() % n); }

  /// Uniform on the unit circle; by square roots alone, which every machine rounds alike.
  Point2 direction() {
    for (;;) {
      const Point2 p{between(-1, 1), between(-1, 1)};
      if (const double r2 = squared_length(p); r2 > 0.01 && r2 <= 1) return 1 / std::sqrt(r2) * p;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace cutbench
