// Integrals over a triangle of what behaves like powers of sqrt(r) round a tip: Gauss's rule with 5 x 5 points in
// coordinates that collapse one side (Duffy, SIAM J. Numer. Anal. 19, 1982), on triangles divided towards the tip.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "harness/base/conversions.h"
#include "harness/mesh/types.h"

namespace cutbench {

/// The radial coordinate is squared where corner 0 is the tip, which makes powers of sqrt(r) polynomials.
template <class Add>
void integrate_from_corner(const std::array<Point2, 3>& c, bool squared, Add&& add) {
  constexpr std::array<std::array<double, 2>, 5> gauss{{{0.046910077030668, 0.118463442528095},
                                                        {0.230765344947158, 0.239314335249683},
                                                        {0.5, 0.284444444444444},
                                                        {0.769234655052842, 0.239314335249683},
                                                        {0.953089922969332, 0.118463442528095}}};
  const Point2 u = c[1] - c[0], v = c[2] - c[0];
  const double twice = cross(u, v);
  for (const auto& [q, of_q] : gauss) {
    const double s = squared ? q * q : q, of_s = squared ? 2 * q * of_q : of_q;
    for (const auto& [t, of_t] : gauss) add(c[0] + s * ((1 - t) * u + t * v), twice * s * of_s * of_t);
  }
}

/// On triangles with sides up to `longest`. add(point, weight): the weights add up to the area. \pre each tip is a
/// corner, or outside
template <class Add>
void integrate_near_tips(std::array<Point2, 3> c, std::span<const Point2> tips, double longest, Add&& add,
                         int depth = 0) {
  constexpr int deepest = 50;
  const auto is_tip = [&](Point2 p) { return std::find(tips.begin(), tips.end(), p) != tips.end(); };
  for (int k = 0; k < 2 && !is_tip(c[0]); ++k) std::rotate(c.begin(), c.begin() + 1, c.end());
  const bool at_tip = is_tip(c[0]);
  std::array<double, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = squared_length(c[(k + 1) % 3] - c[k]);
  std::size_t from = to_size(std::max_element(side.begin(), side.end()) - side.begin());
  const Point2 centre = 1.0 / 3 * (c[0] + c[1] + c[2]);
  bool divide = side[from] > longest * longest;
  divide = divide || std::any_of(tips.begin(), tips.end(), [&](Point2 tip) {
             return !(at_tip && tip == c[0]) && 4 * side[from] > squared_length(centre - tip);
           });
  if (at_tip && !divide) {  // the side opposite, where the tip sees it at a wide angle
    const double foot = std::clamp(dot(c[0] - c[1], c[2] - c[1]) / side[1], 0.0, 1.0);
    from = 1;
    divide = side[1] > squared_length(c[1] + foot * (c[2] - c[1]) - c[0]);
  }
  if (!divide || depth == deepest) return integrate_from_corner(c, at_tip, add);
  const std::size_t to = (from + 1) % 3, apex = (from + 2) % 3;
  const Point2 middle = 0.5 * (c[from] + c[to]);
  integrate_near_tips({c[apex], c[from], middle}, tips, longest, add, depth + 1);
  integrate_near_tips({c[apex], middle, c[to]}, tips, longest, add, depth + 1);
}

}  // namespace cutbench
