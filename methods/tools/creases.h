// Where a sheet that is its own rest shape (Sheet::unrolled()) is not plane. A polygon over a crease, or a vertex that
// follows a plane beyond it, would have forces at rest: both are linear in the sheet's chart.
#pragma once

#include <array>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Lengths that differ by a smaller share are equal, and places by a smaller share of the mean edge: rounding.
constexpr double plane_rounding = 1e-9;

/// Do the triangles at an edge lie in two planes at rest? \pre h is not on the border
inline bool is_creased(const Sheet& sheet, HalfEdge h) {
  if (!sheet.unrolled()) return false;
  const auto far = [&](HalfEdge side) { return to_size(corner_of(Sheet::previous(side))); };
  const Triangle &one = sheet.triangle(triangle_of(h)), &other = sheet.triangle(triangle_of(sheet.opposite(h)));
  const std::size_t k = far(h), l = far(sheet.opposite(h));
  const double flat = length(sheet.rest(one.vertex[k]) - sheet.rest(other.vertex[l]));
  const double in_space = length(sheet.position(one.deformed[k]) + -1.0 * sheet.position(other.deformed[l]));
  return std::abs(flat - in_space) > plane_rounding * flat;
}

/// Is a vertex at rest where these masters put it?
inline bool is_at_rest(const Sheet& sheet, DeformedIndex vertex, const std::array<DeformedIndex, 3>& masters,
                       const std::array<double, 3>& weights) {
  if (!sheet.unrolled()) return true;
  Point3 off = -1.0 * sheet.position(vertex);
  for (std::size_t k = 0; k < 3; ++k) off = off + weights[k] * sheet.position(masters[k]);
  return length(off) <= plane_rounding * sheet.mean_edge();
}

}  // namespace cutbench
