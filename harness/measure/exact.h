// The exact sign of an orientation, and an area good to about 1e-15 of itself.
//
// Deliberately not CGAL's predicates: the code under test uses those, and a checker that shares its predicate with
// what it checks shares its mistakes.
#pragma once

#include "harness/measure/plane.h"

namespace cutbench::oracle {

/// +1 where a, b, c turn counter-clockwise, -1 clockwise, 0 on one line: exact for the stored doubles, also where
/// products under- or overflow. Precondition: all coordinates are finite.
int orientation(const Point& a, const Point& b, const Point& c);

/// Sum of the signed areas of all triangles. Error at most (#T + 8) 2^-64 times the sum over the triangles of the
/// product of two edge lengths (x87 long double; its exponents can't overflow here).
long double area(const Mesh& mesh);

}  // namespace cutbench::oracle
