#include "harness/study/every_edge.h"

#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Real roots of a t^3 + b t^2 + c t + d (Numerical Recipes, 3rd edition, 5.6).
int solve_cubic(double a, double b, double c, double d, double* root) {
  const double scale = std::abs(a) + std::abs(b) + std::abs(c) + std::abs(d);
  if (std::abs(a) <= 1e-14 * scale) {
    if (std::abs(b) <= 1e-14 * scale) {
      if (c == 0) return 0;
      return root[0] = -d / c, 1;
    }
    const double discriminant = c * c - 4 * b * d;
    if (discriminant < 0) return 0;
    const double q = -0.5 * (c + std::copysign(std::sqrt(discriminant), c));
    root[0] = q / b;
    root[1] = q == 0 ? 0 : d / q;
    return 2;
  }
  const double p = b / a, q = c / a, r = d / a;
  const double big_q = (p * p - 3 * q) / 9, big_r = (2 * p * p * p - 9 * p * q + 27 * r) / 54;
  if (big_r * big_r < big_q * big_q * big_q) {
    const double theta = std::acos(big_r / std::sqrt(big_q * big_q * big_q)), s = -2 * std::sqrt(big_q);
    for (int k = 0; k < 3; ++k) root[k] = s * std::cos((theta + 2 * std::numbers::pi * (k - 1)) / 3) - p / 3;
    return 3;
  }
  const double u = -std::copysign(std::cbrt(std::abs(big_r) + std::sqrt(big_r * big_r - big_q * big_q * big_q)), big_r);
  root[0] = u + (u == 0 ? 0 : big_q / u) - p / 3;
  return 1;
}

int crossings(const Point2* p, Point2 a, Point2 b) {
  const Point2 edge = b - a;
  const double length2 = squared_length(edge);
  double s[4];  // signed areas of the control points over the edge's line: the same cubic's coefficients
  for (int i = 0; i < 4; ++i) s[i] = cross(edge, p[i] - a);
  double root[3];
  const int n =
      solve_cubic(s[3] - 3 * s[2] + 3 * s[1] - s[0], 3 * (s[2] - 2 * s[1] + s[0]), 3 * (s[1] - s[0]), s[0], root);
  int count = 0;
  for (int i = 0; i < n; ++i) {
    const double t = root[i], u = 1 - t;
    if (t < 0 || t > 1) continue;
    const Point2 q = u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
    const double along = dot(q - a, edge);
    count += along >= 0 && along <= length2;
  }
  return count;
}

}  // namespace

std::size_t count_crossings_by_every_edge(const Sheet& sheet, const Curve& curve) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    if (!sheet.triangle(TriangleIndex(i)).alive()) continue;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(i), k);
      if (!sheet.on_border(h) && sheet.opposite(h) < h) continue;  // each edge once
      for (std::size_t j = 0; j + 3 < curve.points.size(); j += 3)
        count += to_size(crossings(&curve.points[j], sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h))));
    }
  }
  return count;
}

}  // namespace cutbench
