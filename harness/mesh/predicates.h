// Exact decisions on stored doubles: CGAL's Epick kernel (filtered floating point, exact where the filter can't tell),
// behind a first, cheaper filter for the orientation. Needs CGAL_ALWAYS_ROUND_TO_NEAREST, which the interface target
// `cutbench_cgal` defines.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/types.h"

namespace cutbench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Kernel::Point_2 to_cgal(Point2 p) { return {p.x, p.y}; }

/// +1 where c lies left of the directed line a -> b, -1 right of it, 0 exactly on it.
inline int orientation(Point2 a, Point2 b, Point2 c) {
  // Stage A of Shewchuk's filter (Adaptive precision floating-point arithmetic, 1997, theorem: ccwerrboundA); products
  // below 1e-280 could have lost digits to underflow.
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), difference = left - right;
  const double magnitude = std::abs(left) + std::abs(right);
  if (std::abs(difference) > 3.3306690738754716e-16 * magnitude && magnitude > 1e-280 && magnitude < 1e300)
    return difference > 0 ? 1 : -1;
  return to_int(CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c)));
}

/// +1 where d lies strictly inside the circumcircle of the counter-clockwise triangle a, b, c, 0 on it, -1 outside.
inline int in_circle(Point2 a, Point2 b, Point2 c, Point2 d) {
  return to_int(CGAL::side_of_oriented_circle(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)));
}

}  // namespace cutbench
