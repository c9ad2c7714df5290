// The three rows of a triangle, for either kind of bending.

#include <cmath>

#include "harness/fem/elements/bending.h"

namespace cutbench {

namespace {

/// \return the triangle on the other side of side k, invalid where the side is on the border or an incision.
TriangleIndex neighbour(const Sheet& sheet, TriangleIndex t, std::size_t k) {
  const Triangle& triangle = sheet.triangle(t);
  if (!triangle.opposite[k].valid() || triangle.mark[k] == EdgeMark::incision) return {};
  return triangle_of(triangle.opposite[k]);
}

double twice_area(const std::array<Point2, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); }

}  // namespace

/// Of the element that t belongs to.
double Bending::twice_area(const Sheet& sheet, TriangleIndex t) const {
  double sum = 0;
  for (const TriangleIndex member : members(t)) sum += std::max(0.0, cutbench::twice_area(sheet.corners(member)));
  return sum;
}

/// Hessian H of the quadratic with the triangle's corners and, at the middles of its sides, the averaged slopes (that
/// of Morley's triangle): 1/area times the sum over the sides of length x outward normal (x) gradient, made symmetric.
/// A slope is averaged with the triangles' heights as weights (their areas, the side being common), so that the poor
/// slope of a sliver counts little. The energy D/2 area ((1-nu) |H|^2 + nu (tr H)^2) is the sum of the squares of (Hxx
/// + Hyy)/sqrt(2), (Hxx - Hyy)/sqrt(2) and Hxy with the weights below.
void Bending::patch_rows(const Sheet& sheet, TriangleIndex t) {
  const double twice = twice_area(sheet, t);
  if (!(twice > 0)) return;  // positive by the exact predicate, but not in doubles
  const std::array<double, 3> weight{std::sqrt(rigidity_ * (1 + poisson_) * twice / 2),
                                     std::sqrt(rigidity_ * (1 - poisson_) * twice / 2),
                                     std::sqrt(rigidity_ * (1 - poisson_) * twice)};
  const auto rows_of = [&](double xx, double yy, double xy) {
    const double f = -2 / twice;
    return std::array{f * weight[0] * (xx + yy) * M_SQRT1_2, f * weight[1] * (xx - yy) * M_SQRT1_2, f * weight[2] * xy};
  };
  const auto add = [&](std::int32_t vertex, const std::array<double, 3>& rows, double factor) {
    auto& sum = term_of(vertex);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += factor * rows[i];
  };
  for (const TriangleIndex member : members(t)) {
    const auto c = sheet.corners(member);
    const auto& corner = sheet.triangle(member).deformed;
    std::array<std::array<double, 3>, 3> own{};  // what the element's own slope at each side counts in the three
                                                 // rows
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleIndex other = neighbour(sheet, member, k);
      if (other.valid() && members(other).data() == members(t).data()) continue;  // within the polygon
      const Point2 side = c[(k + 1) % 3] - c[k];
      const double length = std::sqrt(squared_length(side));
      const Point2 along = 1 / length * side, inward{-along.y, along.x};
      // The derivative along the side, exact from its ends.
      const auto twist = rows_of(inward.x * along.x, inward.y * along.y, (inward.x * along.y + inward.y * along.x) / 2);
      add(corner[(k + 1) % 3].value, twist, 1), add(corner[k].value, twist, -1);
      // The one across it.
      const auto bend = rows_of(inward.x * inward.x, inward.y * inward.y, inward.x * inward.y);
      const double twice_other = other.valid() ? twice_area(sheet, other) : 0;
      const double share = twice / (twice + twice_other);
      for (std::size_t i = 0; i < 3; ++i) own[k][i] = length * share * bend[i];
      if (!(twice_other > 0)) continue;
      const auto there = static_cast<std::size_t>(corner_of(sheet.triangle(member).opposite[k]));
      for (const auto& [vertex, slope] : slopes_[other()]) add(vertex, bend, -length * (1 - share) * slope[there]);
    }
    for (const auto& [vertex, slope] : slopes_[member()]) {
      auto& sum = term_of(vertex);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += own[0][i] * slope[0] + own[1][i] * slope[1] + own[2][i] * slope[2];
    }
  }
}

/// Row k: the hinge of side k, whose energy D/2 3/(A0 + A1) |sum c x|^2 the two triangles share. Bergou's cotangents
/// add up to c x = side length x (slope on this side + slope on the other, both inward).
void Bending::hinge_rows(const Sheet& sheet, TriangleIndex t) {
  const double twice = cutbench::twice_area(sheet.corners(t));
  for (std::size_t k = 0; k < 3; ++k) {
    const TriangleIndex other = neighbour(sheet, t, k);
    if (!other.valid()) continue;
    const double twice_other = cutbench::twice_area(sheet.corners(other));
    if (!(twice > 0 && twice_other > 0)) continue;  // positive by the exact predicate, but not in doubles
    const double weight = std::sqrt(rigidity_ * 3 / (twice + twice_other));
    const auto add_slope = [&](TriangleIndex of, std::size_t side, double twice_its_area) {
      const auto c = sheet.corners(of);
      const auto& d = sheet.triangle(of).deformed;
      const std::size_t next = (side + 1) % 3, far = (side + 2) % 3;
      const Point2 edge = c[next] - c[side];
      const double factor = weight * squared_length(edge) / twice_its_area;
      const double foot = dot(c[far] - c[side], edge) / squared_length(edge);
      term_of(d[far].value)[k] += factor;
      term_of(d[side].value)[k] -= factor * (1 - foot);
      term_of(d[next].value)[k] -= factor * foot;
    };
    add_slope(t, k, twice);
    add_slope(other, static_cast<std::size_t>(corner_of(sheet.triangle(t).opposite[k])), twice_other);
  }
}

}  // namespace cutbench
