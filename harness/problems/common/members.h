// What the members of all ensembles share: the sheet's material, their random numbers, and how near a mesh line a cut
// may run.
#pragma once

#include <array>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/problems/common/elastic_field.h"

namespace cutbench {

inline constexpr Elastic sheet_material{.young = 1000, .poisson = 0.3};
inline constexpr double pull = 1;  ///< N/m, of the problems in the plane

/// The numbers that a member draws, the same on every sheet. The k-th ones of all members together fill their interval
/// evenly (Richtmyer 1951: multiples of the square roots of primes, from where the seed says on), so that the mean over
/// few members is nearer to that over all than with independent numbers. Even and odd members have sequences of their
/// own.
class MemberNumbers {
 public:
  MemberNumbers(std::uint64_t seed, std::size_t index)
      : start_(seed + 0x9E3779B97F4A7C15u * (index % 2 + 1)), turns_(index / 2) {}
  double between(double a, double b) { return a + (b - a) * unit(); }
  bool coin() { return unit() < 0.5; }

 private:
  double unit() {
    constexpr std::array<double, 6> primes{2, 3, 5, 7, 11, 13};
    const double number = start_.unit() + to_double(turns_) * std::sqrt(primes.at(drawn_++));
    return number - std::floor(number);
  }

  Random start_;
  std::size_t turns_;
  std::size_t drawn_ = 0;
};

/// Distance of an even member from the nearest mesh line of a grid, in cells: 0.5e-6 to 0.5 on either side, evenly in
/// its logarithm, for the aspect ratio of the slivers that a split leaves goes like its inverse.
inline double distance_from_mesh_line(MemberNumbers& numbers) {
  const double distance = 0.5 * std::pow(10, numbers.between(-6, 0));
  return numbers.coin() ? distance : -distance;
}

}  // namespace cutbench
