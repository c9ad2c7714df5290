// Exact decisions on stored doubles, behind a first, cheap filter for the orientation.
#pragma once

#include <cmath>

#include "harness/mesh/types.h"

namespace cutbench {

/// As orientation(), without the first filter.
int exact_orientation(Point2 a, Point2 b, Point2 c);

/// +1 where c lies left of the directed line a -> b, -1 right of it, 0 exactly on it.
inline int orientation(Point2 a, Point2 b, Point2 c) {
  // Stage A of Shewchuk's filter (Adaptive precision floating-point arithmetic, 1997, theorem: ccwerrboundA); products
  // below 1e-280 could have lost digits to underflow.
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), difference = left - right;
  const double magnitude = std::abs(left) + std::abs(right);
  if (std::abs(difference) > 3.3306690738754716e-16 * magnitude && magnitude > 1e-280 && magnitude < 1e300)
    return difference > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

/// +1 where d lies strictly inside the circumcircle of the counter-clockwise triangle a, b, c, 0 on it, -1 outside.
int in_circle(Point2 a, Point2 b, Point2 c, Point2 d);

}  // namespace cutbench
