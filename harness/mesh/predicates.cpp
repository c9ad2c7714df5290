#include "harness/mesh/predicates.h"

#include "harness/base/conversions.h"
#include "harness/mesh/cgal_kernel.h"

namespace cutbench {

int exact_orientation(Point2 a, Point2 b, Point2 c) {
  return to_int(CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c)));
}

int exact_in_circle(Point2 a, Point2 b, Point2 c, Point2 d) {
  return to_int(CGAL::side_of_oriented_circle(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)));
}

}  // namespace cutbench
