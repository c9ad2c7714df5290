// Requested curves as chains of straight segments: the oracle's own flattening.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// One straight piece of a flattened curve, with the curve's unit tangents at its ends.
struct PathSegment {
  Segment segment;
  Point tangent_start;
  Point tangent_end;
};

/// The segments of one curve, each starting where the one before ended; empty for a curve of no length. The curve is
/// nowhere farther than `tolerance` (rest units, > 0) from its segments; joints of a Bezier chain and the corners of a
/// polyline are kept exactly. De Casteljau halving until the control points are that near their chord.
/// Throws std::invalid_argument: no points, not 3 k + 1 of them, a closed Bezier that does not end where it began, a
/// coordinate that is not finite.
std::vector<PathSegment> flatten(const Curve& curve, double tolerance);

}  // namespace cutbench::oracle
