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

std::array<Point3, 3> positions(const Sheet& sheet, const DeformedState& state, TriangleIndex t) {
  const auto& d = sheet.triangle(t).deformed;
  return {state.position(sheet, d[0]), state.position(sheet, d[1]), state.position(sheet, d[2])};
}

Point3 normal(const Sheet& sheet, const DeformedState& state, TriangleIndex t) {
  const auto p = positions(sheet, state, t);
  return cross(minus(p[1], p[0]), minus(p[2], p[0]));
}

Tensor curvature(const Sheet& sheet, const DeformedState& state, TriangleIndex t) {
  Tensor s;
  const auto c = sheet.corners(t);
  const double area = cross(c[1] - c[0], c[2] - c[0]) / 2;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (sheet.separates(h)) continue;
    const Point2 edge = c[to_size(next_corner(k))] - c[to_size(k)];
    const double length = std::sqrt(squared_length(edge));
    s.add(-0.5 * bend_angle(sheet, state, h) * length / area, 1 / length * Point2{-edge.y, edge.x});
  }
  return s;
}

/// F^T F, of what has these values at the corners.
Tensor squared_gradient(const Sheet& sheet, TriangleIndex t, const std::array<Point3, 3>& value) {
  const auto c = sheet.corners(t);
  const Point2 u = c[1] - c[0], v = c[2] - c[0];
  const Point3 x = minus(value[1], value[0]), y = minus(value[2], value[0]);
  const double twice = cross(u, v);
  const Point3 along_x = minus(v.y / twice * x, u.y / twice * y), along_y = minus(u.x / twice * y, v.x / twice * x);
  return {dot(along_x, along_x), dot(along_x, along_y), dot(along_y, along_y)};
}

std::array<Point3, 3> velocities(const Sheet& sheet, const DeformedState& state, TriangleIndex t) {
  const auto& d = sheet.triangle(t).deformed;
  return {state.velocity(d[0]), state.velocity(d[1]), state.velocity(d[2])};
}

/// The larger principal one, over Young's modulus. \param twice_strain  eigenvalues of F^T F - 1, the smaller first
double principal_stress(const std::array<double, 2>& twice_strain, double poisson) {
  return (twice_strain[1] + poisson * twice_strain[0]) / (2 * (1 - poisson * poisson));
}

}  // namespace

double bend_angle(const Sheet& sheet, const DeformedState& state, HalfEdge h) {
  const TriangleIndex t = triangle_of(h);
  const auto p = positions(sheet, state, t);
  const Point3 edge = minus(p[to_size(next_corner(corner_of(h)))], p[to_size(corner_of(h))]);
  const Point3 n = normal(sheet, state, t), m = normal(sheet, state, triangle_of(sheet.opposite(h)));
  const double length = std::sqrt(dot(edge, edge));
  return length > 0 ? std::atan2(dot(edge, cross(n, m)) / length, dot(n, m)) : 0;
}

double deformed_metric(const Sheet& sheet, const DeformedState& state, TriangleIndex t, const DeformedTerms& terms,
                       double h, double h_tip) {
  constexpr double rounding = 1e-12;  // of F^T F at rest
  double metric = 0;
  if (terms.angle > 0)
    for (const double kappa : curvature(sheet, state, t).eigenvalues())
      metric = std::max(metric, kappa * kappa / (terms.angle * terms.angle));
  Tensor strain = squared_gradient(sheet, t, positions(sheet, state, t));
  strain.xx -= 1;
  strain.yy -= 1;
  const auto twice_strain = strain.eigenvalues();
  if (terms.compression > 0 && twice_strain[0] < -rounding)
    metric = std::max(metric, -twice_strain[0] / (terms.compression * terms.compression * h * h));
  if (!state.motion()) return metric;
  if (terms.velocity > 0) {
    const Tensor rate = squared_gradient(sheet, t, velocities(sheet, state, t));
    metric = std::max(metric, rate.eigenvalues()[1] / (terms.velocity * terms.velocity));
  }
  if (terms.stress > 0) {
    const double share = principal_stress(twice_strain, state.motion()->poisson) / terms.stress;
    metric = std::max(metric, std::clamp((share - 0.25) / 0.75, 0.0, 1.0) / (h_tip * h_tip));
  }
  return metric;
}

}  // namespace cutbench
