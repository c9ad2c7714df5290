#include "methods/adaptive_remesh/deformed_metric.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/base/products_in_space.h"

namespace cutbench {

namespace {

/// Symmetric, of the rest plane.
struct Tensor {
  double xx = 0, xy = 0, yy = 0;

  void add(double weight, Point2 t) {
    xx += weight * t.x * t.x;
    xy += weight * t.x * t.y;
    yy += weight * t.y * t.y;
  }
  std::array<double, 2> eigenvalues() const {  // the smaller first
    const double mean = (xx + yy) / 2, radius = std::hypot((xx - yy) / 2, xy);
    return {mean - radius, mean + radius};
  }
};

Point3 minus(Point3 a, Point3 b) { return a + -1 * b; }

std::array<Point3, 3> positions(const Sheet& sheet, TriangleIndex t) {
  const auto& d = sheet.triangle(t).deformed;
  return {sheet.position(d[0]), sheet.position(d[1]), sheet.position(d[2])};
}

Point3 normal(const Sheet& sheet, TriangleIndex t) {
  const auto p = positions(sheet, t);
  return cross(minus(p[1], p[0]), minus(p[2], p[0]));
}

Tensor curvature(const Sheet& sheet, TriangleIndex t) {
  Tensor s;
  const auto c = sheet.corners(t);
  const double area = cross(c[1] - c[0], c[2] - c[0]) / 2;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (sheet.separates(h)) continue;
    const Point2 edge = c[to_size(next_corner(k))] - c[to_size(k)];
    const double length = std::sqrt(squared_length(edge));
    s.add(-0.5 * bend_angle(sheet, h) * length / area, 1 / length * Point2{-edge.y, edge.x});
  }
  return s;
}

/// F^T F - 1.
Tensor strain(const Sheet& sheet, TriangleIndex t) {
  const auto c = sheet.corners(t);
  const auto p = positions(sheet, t);
  const Point2 u = c[1] - c[0], v = c[2] - c[0];
  const Point3 x = minus(p[1], p[0]), y = minus(p[2], p[0]);
  const double twice = cross(u, v);
  const Point3 along_x = minus(v.y / twice * x, u.y / twice * y), along_y = minus(u.x / twice * y, v.x / twice * x);
  return {dot(along_x, along_x) - 1, dot(along_x, along_y), dot(along_y, along_y) - 1};
}

}  // namespace

double bend_angle(const Sheet& sheet, HalfEdge h) {
  const TriangleIndex t = triangle_of(h);
  const auto p = positions(sheet, t);
  const Point3 edge = minus(p[to_size(next_corner(corner_of(h)))], p[to_size(corner_of(h))]);
  const Point3 n = normal(sheet, t), m = normal(sheet, triangle_of(sheet.opposite(h)));
  const double length = std::sqrt(dot(edge, edge));
  return length > 0 ? std::atan2(dot(edge, cross(n, m)) / length, dot(n, m)) : 0;
}

double deformed_metric(const Sheet& sheet, TriangleIndex t, double angle, double c) {
  constexpr double rounding = 1e-12;  // of F^T F at rest
  double metric = 0;
  if (angle > 0)
    for (const double kappa : curvature(sheet, t).eigenvalues())
      metric = std::max(metric, kappa * kappa / (angle * angle));
  if (c > 0)
    if (const double least = strain(sheet, t).eigenvalues()[0]; least < -rounding)
      metric = std::max(metric, -least / (c * c));
  return metric;
}

}  // namespace cutbench
