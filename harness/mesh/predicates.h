// Exact decisions on stored doubles, behind a first, cheap filter.
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

/// As in_circle(), without the first filter.
int exact_in_circle(Point2 a, Point2 b, Point2 c, Point2 d);

/// +1 where d lies strictly inside the circumcircle of the counter-clockwise triangle a, b, c, 0 on it, -1 outside.
inline int in_circle(Point2 a, Point2 b, Point2 c, Point2 d) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
  const double determinant = aa * (bc - cb) + bb * (ca - ac) + cc * (ab - ba);
  const double magnitude =
      aa * (std::abs(bc) + std::abs(cb)) + bb * (std::abs(ca) + std::abs(ac)) + cc * (std::abs(ab) + std::abs(ba));
  // Stage A of Shewchuk's filter (as above, iccerrboundA). Within these bounds all that is lost to underflow, at most
  // some 5e-324 * 1e140, is far below the filter's own error.
  if (std::abs(determinant) > 1.1102230246251577e-15 * magnitude && magnitude > 1e-130 && aa + bb + cc < 1e140)
    return determinant > 0 ? 1 : -1;
  return exact_in_circle(a, b, c, d);
}

}  // namespace cutbench
