// What the members of all ensembles share: the sheet's material, their random numbers, and how near a mesh line a cut
// may run.
#pragma once

#include <cmath>

#include "harness/run/random.h"
#include "harness/truth/elastic_field.h"

namespace cutbench {

inline constexpr Elastic sheet_material{.young = 1000, .poisson = 0.3};
inline constexpr double pull = 1;  ///< N/m, of the problems in the plane

/// One sequence per member, the same on every sheet.
inline Random member_random(std::uint64_t seed, std::size_t index) {
  return Random(seed + 0x9E3779B97F4A7C15u * (index + 1));
}

/// Distance of an even member from the nearest mesh line of a grid, in cells: 0.5e-6 to 0.5 on either side, evenly in
/// its logarithm, for the aspect ratio of the slivers that a split leaves goes like its inverse.
inline double distance_from_mesh_line(Random& random) {
  const double distance = 0.5 * std::pow(10, random.between(-6, 0));
  return random.coin() ? distance : -distance;
}

}  // namespace cutbench
