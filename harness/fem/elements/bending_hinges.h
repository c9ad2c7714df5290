// The quadratic hinge (Bergou et al. 2006, A quadratic bending model for inextensible surfaces), as the kind that
// shows how an energy depends on the mesh.
#pragma once

#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/elements/rest_corners.h"

namespace cutbench {

/// Row k: the hinge of side k, whose energy D/2 3/(A0 + A1) |sum c x|^2 the two triangles share. Bergou's cotangents
/// add up to c x = side length x (slope on this side + slope on the other, both inward). Over a seam the other
/// triangle's side may have another length: then it counts as one that is scaled along its side to ours.
inline void hinge_rows(BendingStencil& stencil, TriangleIndex t) {
  const Sheet& sheet = stencil.sheet;
  const double twice = twice_area(rest_corners(sheet, t));
  const auto side_of = [&](TriangleIndex of, std::size_t side) {
    const auto c = rest_corners(sheet, of);
    return c[(side + 1) % 3] - c[side];
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfEdge across = stencil.across(t, k);
    if (!across.valid()) continue;
    const TriangleIndex other = triangle_of(across);
    const std::size_t other_side = to_size(corner_of(across));
    const double twice_other = twice_area(rest_corners(sheet, other));
    if (!(twice > 0 && twice_other > 0)) continue;  // positive by the exact predicate, but not in doubles
    const bool is_seam = !sheet.triangle(t).opposite[k].valid();
    const double scale = is_seam ? length(side_of(t, k)) / length(side_of(other, other_side)) : 1;
    const double weight = std::sqrt(stencil.rigidity * 3 / (twice + scale * twice_other));
    const auto add_slope = [&](TriangleIndex of, std::size_t side, double twice_its_area, double its_scale) {
      const auto c = rest_corners(sheet, of);
      const auto& d = sheet.triangle(of).deformed;
      const std::size_t next = (side + 1) % 3, far = (side + 2) % 3;
      const Point2 edge = side_of(of, side);
      const double factor = weight * its_scale * squared_length(edge) / twice_its_area;
      const double foot = dot(c[far] - c[side], edge) / squared_length(edge);
      stencil.at(d[far].value)[k] += factor;
      stencil.at(d[side].value)[k] -= factor * (1 - foot);
      stencil.at(d[next].value)[k] -= factor * foot;
    };
    add_slope(t, k, twice, 1);
    add_slope(other, other_side, twice_other, scale);
  }
}

}  // namespace cutbench
