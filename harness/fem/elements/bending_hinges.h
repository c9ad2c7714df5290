// The quadratic hinge (Bergou et al. 2006, A quadratic bending model for inextensible surfaces), as the kind that
// shows how an energy depends on the mesh.
#pragma once

#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_kinds.h"

namespace cutbench {

/// Row k: the hinge of side k, whose energy D/2 3/(A0 + A1) |sum c x|^2 the two triangles share. Bergou's cotangents
/// add up to c x = side length x (slope on this side + slope on the other, both inward).
inline void hinge_rows(BendingStencil& stencil, TriangleIndex t) {
  const Sheet& sheet = stencil.sheet;
  const double twice = twice_area(sheet.corners(t));
  for (std::size_t k = 0; k < 3; ++k) {
    const TriangleIndex other = stencil.neighbour(t, k);
    if (!other.valid()) continue;
    const double twice_other = twice_area(sheet.corners(other));
    if (!(twice > 0 && twice_other > 0)) continue;  // positive by the exact predicate, but not in doubles
    const double weight = std::sqrt(stencil.rigidity * 3 / (twice + twice_other));
    const auto add_slope = [&](TriangleIndex of, std::size_t side, double twice_its_area) {
      const auto c = sheet.corners(of);
      const auto& d = sheet.triangle(of).deformed;
      const std::size_t next = (side + 1) % 3, far = (side + 2) % 3;
      const Point2 edge = c[next] - c[side];
      const double factor = weight * squared_length(edge) / twice_its_area;
      const double foot = dot(c[far] - c[side], edge) / squared_length(edge);
      stencil.at(d[far].value)[k] += factor;
      stencil.at(d[side].value)[k] -= factor * (1 - foot);
      stencil.at(d[next].value)[k] -= factor * foot;
    };
    add_slope(t, k, twice);
    add_slope(other, to_size(corner_of(sheet.triangle(t).opposite[k])), twice_other);
  }
}

}  // namespace cutbench
