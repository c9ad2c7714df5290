// What the oracle knows: points, an opened sheet, requested curves; and a few formulas of the plane.
//
// The oracle judges harness/cut, so nothing here comes from there or from harness/mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cutbench::oracle {

/// A point or a vector of rest space.
using Point = std::array<double, 2>;

using Segment = std::array<Point, 2>;

/// An opened sheet. One rest point per deformed vertex: the two lips of an incision are different vertices whose rest
/// points are equal. Triangles are counter-clockwise, #T by 3, and cover no point of the plane twice.
struct Mesh {
  std::vector<Point> rest;
  std::vector<std::array<int, 3>> triangles;
};

/// A requested cut in rest space: a chain of cubic Bezier pieces (3 k + 1 points; a closed one ends where it began) or
/// a polyline (a closed one repeats no point).
struct Curve {
  bool bezier = false;
  bool closed = false;
  std::vector<Point> points;
};

inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }
inline double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
inline double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// a at t = 0 and b at t = 1, both exactly.
inline Point between(const Point& a, const Point& b, double t) {
  return {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]};
}

/// Precondition: a != b.
inline Point direction(const Point& a, const Point& b) {
  const double l = distance(a, b);
  return {(b[0] - a[0]) / l, (b[1] - a[1]) / l};
}

/// The point of s nearest to p.
inline Point nearest(const Point& p, const Segment& s) {
  const Point along = minus(s[1], s[0]);
  const double squared = dot(along, along);
  const double t = squared > 0 ? std::clamp(dot(minus(p, s[0]), along) / squared, 0.0, 1.0) : 0.0;
  return between(s[0], s[1], t);
}

inline double distance(const Point& p, const Segment& s) { return distance(p, nearest(p, s)); }

}  // namespace cutbench::oracle
