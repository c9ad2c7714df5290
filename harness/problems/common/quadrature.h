// Integrals over triangles, with square-root tips of cuts among the integrands.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "harness/base/conversions.h"
#include "harness/mesh/types.h"

namespace cutbench {

/// Six points, exact for polynomials of degree 4 (Strang and Fix 1973; Dunavant 1985). add(point, weight): the weights
/// add up to the area.
template <class Add>
void integrate_smooth(const std::array<Point2, 3>& c, Add&& add) {
  constexpr std::array<std::array<double, 2>, 2> rule{
      {{0.445948490915965, 0.223381589678011}, {0.091576213509771, 0.109951743655322}}};
  const double area = cross(c[1] - c[0], c[2] - c[0]) / 2;
  for (const auto& [a, weight] : rule)
    for (std::size_t k = 0; k < 3; ++k) add(a * (c[0] + c[1] + c[2]) + (1 - 3 * a) * c[k], weight * area);
}

/// For what grows like 1/r towards corner 0: Duffy's transformation (SIAM J. Numer. Anal. 19, 1982), 5 x 5 points, of
/// triangles that are seen from there at a moderate angle.
template <class Add>
void integrate_at_tip(const std::array<Point2, 3>& c, Add&& add, int depth = 0) {
  constexpr int deepest = 40;
  const Point2 u = c[1] - c[0], v = c[2] - c[0], across = c[2] - c[1];
  const double foot = std::clamp(-dot(u, across) / squared_length(across), 0.0, 1.0);
  if (depth < deepest && squared_length(across) > squared_length(u + foot * across)) {
    const Point2 middle = 0.5 * (c[1] + c[2]);
    integrate_at_tip({c[0], c[1], middle}, add, depth + 1);
    integrate_at_tip({c[0], middle, c[2]}, add, depth + 1);
    return;
  }
  constexpr double far = 0.906179845938664, near = 0.538469310105683;
  constexpr std::array<std::array<double, 2>, 5> gauss{{{(1 - far) / 2, 0.118463442528095},
                                                        {(1 - near) / 2, 0.239314335249683},
                                                        {0.5, 0.284444444444444},
                                                        {(1 + near) / 2, 0.239314335249683},
                                                        {(1 + far) / 2, 0.118463442528095}}};
  for (const auto& [s, ws] : gauss)
    for (const auto& [t, wt] : gauss) add(c[0] + s * ((1 - t) * u + t * v), cross(u, v) * s * ws * wt);
}

/// Of a triangle anywhere relative to the tips: divided at a tip inside it, and bisected across its longest side while
/// that is longer than the way to the nearest tip, or than `longest`.
template <class Add>
void integrate(std::array<Point2, 3> c, std::span<const Point2> tips, double longest, Add&& add, int depth = 0) {
  constexpr int deepest = 40;
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  if (!(area > 0)) return;
  std::array<double, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = squared_length(c[(k + 1) % 3] - c[k]);
  const std::size_t k = to_size(std::max_element(side.begin(), side.end()) - side.begin());
  bool divide = side[k] > longest * longest;
  for (const Point2 tip : tips) {
    for (std::size_t i = 0; i < 3; ++i)
      if (!divide && squared_length(c[i] - tip) <= 1e-18 * side[k])
        return integrate_at_tip({tip, c[(i + 1) % 3], c[(i + 2) % 3]}, add);
    bool inside = true, corner = false;
    for (std::size_t i = 0; i < 3; ++i) {
      inside = inside && cross(c[(i + 1) % 3] - c[i], tip - c[i]) > 1e-12 * area;
      corner = corner || squared_length(c[i] - tip) <= 1e-18 * side[k];
    }
    if (inside) {
      for (std::size_t i = 0; i < 3; ++i) integrate({tip, c[i], c[(i + 1) % 3]}, tips, longest, add, depth + 1);
      return;
    }
    divide = divide || (!corner && side[k] > squared_length(1.0 / 3 * (c[0] + c[1] + c[2]) - tip));
  }
  if (!divide || depth == deepest) return integrate_smooth(c, add);
  const Point2 middle = 0.5 * (c[k] + c[(k + 1) % 3]);
  integrate({c[k], middle, c[(k + 2) % 3]}, tips, longest, add, depth + 1);
  integrate({middle, c[(k + 1) % 3], c[(k + 2) % 3]}, tips, longest, add, depth + 1);
}

}  // namespace cutbench
