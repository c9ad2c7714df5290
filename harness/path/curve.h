// The cut that was asked for: a chain of cubic Beziers or a polyline in rest space, and the polyline it is traced as.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

struct Curve {
  enum class Kind { bezier, polyline };
  Kind kind = Kind::polyline;
  bool closed = false;         ///< a closed polyline repeats no point; a closed Bezier ends where it began
  std::vector<Point2> points;  ///< rest positions; a chain of m cubic Beziers has 3 m + 1
  /// Parts of one curve: the part before it ends where it begins, or the next one begins where it ends. So it has no
  /// tip there, and the place has to stay.
  bool continues = false, goes_on = false;
};

/// Are the points at most `distance` apart, along x and along y?
inline bool within(Point2 a, Point2 b, double distance) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= distance;
}

/// Where a curve goes, for tracing only.
struct Polyline {
  std::vector<Point2> points;
  std::vector<std::uint8_t> kept;           ///< per point: it must become a vertex (tip, corner of the curve)
  bool closed = false;                      ///< goes on from the last point to the first, which it doesn't repeat
  bool curved = false;                      ///< it stands for a Bezier: what lies within the tolerances of it will do
  bool continues = false, goes_on = false;  ///< as of Curve
};

/// The curve as a polyline no farther from it than `tolerance` (rest units): each Bezier in equal steps of its
/// parameter, as many as Wang's formula asks for (Goldman, Pyramid Algorithms, 2003, 5.6.3). Points nearer than `snap`
/// to the one before are left out; a curve of no length gives fewer than two points.
void flatten(const Curve& curve, double tolerance, double snap, Polyline& out);

/// Throws InputError: too few points for the kind, a closed Bezier that doesn't end where it began, NaN or infinity,
/// or a coordinate beyond 1e60 (the exact predicates multiply four of them). `name` says where the curve comes from.
void check_curve(const Curve& curve, const std::string& name);

}  // namespace cutbench
