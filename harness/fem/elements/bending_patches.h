// The enhanced rotation-free shell triangle (Flores and Onate, CMAME 194, 2005, EBST), for a flat rest sheet: slopes
// from the quadratic through a triangle and its three neighbours, averaged on the sides; Hessian from them by the
// divergence theorem. Does not depend on the mesh: passes the bending patch test on any, elements of several triangles
// too.
#pragma once

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_kinds.h"

namespace cutbench {

/// Of the element that t belongs to.
inline double twice_area_of_element(const BendingStencil& stencil, TriangleIndex t) {
  double sum = 0;
  for (const TriangleIndex member : stencil.members(t)) sum += std::max(0.0, twice_area(stencil.sheet.corners(member)));
  return sum;
}

/// Hessian H of the quadratic with the triangle's corners and, at the middles of its sides, the averaged slopes (that
/// of Morley's triangle): 1/area times the sum over the sides of length x outward normal (x) gradient, made symmetric.
/// A slope is averaged with the triangles' heights as weights (their areas, the side being common), so that the poor
/// slope of a sliver counts little. The energy D/2 area ((1-nu) |H|^2 + nu (tr H)^2) is the sum of the squares of (Hxx
/// + Hyy)/sqrt(2), (Hxx - Hyy)/sqrt(2) and Hxy with the weights below.
inline void patch_rows(BendingStencil& stencil, TriangleIndex t) {
  const Sheet& sheet = stencil.sheet;
  const double rigidity = stencil.rigidity, poisson = stencil.poisson;
  const double twice = twice_area_of_element(stencil, t);
  if (!(twice > 0)) return;  // positive by the exact predicate, but not in doubles
  const std::array<double, 3> weight{std::sqrt(rigidity * (1 + poisson) * twice / 2),
                                     std::sqrt(rigidity * (1 - poisson) * twice / 2),
                                     std::sqrt(rigidity * (1 - poisson) * twice)};
  const auto rows_of = [&](double xx, double yy, double xy) {
    const double f = -2 / twice;
    return std::array{f * weight[0] * (xx + yy) * M_SQRT1_2, f * weight[1] * (xx - yy) * M_SQRT1_2, f * weight[2] * xy};
  };
  const auto add = [&](std::int32_t vertex, const std::array<double, 3>& rows, double factor) {
    auto& sum = stencil.at(vertex);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += factor * rows[i];
  };
  for (const TriangleIndex member : stencil.members(t)) {
    const auto c = sheet.corners(member);
    const auto& corner = sheet.triangle(member).deformed;
    std::array<std::array<double, 3>, 3> own{};  // per side: what the element's own slope there counts in the rows
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleIndex other = stencil.neighbour(member, k);
      if (other.valid() && stencil.members(other).data() == stencil.members(t).data()) continue;  // within the element
      const Point2 side = c[(k + 1) % 3] - c[k];
      const double length = std::sqrt(squared_length(side));
      const Point2 along = 1 / length * side, inward{-along.y, along.x};
      // The derivative along the side, exact from its ends.
      const auto twist = rows_of(inward.x * along.x, inward.y * along.y, (inward.x * along.y + inward.y * along.x) / 2);
      add(corner[(k + 1) % 3].value, twist, 1);
      add(corner[k].value, twist, -1);
      // The one across it.
      const auto bend = rows_of(inward.x * inward.x, inward.y * inward.y, inward.x * inward.y);
      const double twice_other = other.valid() ? twice_area_of_element(stencil, other) : 0;
      const double share = twice / (twice + twice_other);
      for (std::size_t i = 0; i < 3; ++i) own[k][i] = length * share * bend[i];
      if (!(twice_other > 0)) continue;
      const auto there = to_size(corner_of(sheet.triangle(member).opposite[k]));
      for (const auto& [vertex, slope] : stencil.slopes[other()])
        add(vertex, bend, -length * (1 - share) * slope[there]);
    }
    for (const auto& [vertex, slope] : stencil.slopes[member()]) {
      auto& sum = stencil.at(vertex);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += own[0][i] * slope[0] + own[1][i] * slope[1] + own[2][i] * slope[2];
    }
  }
}

}  // namespace cutbench
