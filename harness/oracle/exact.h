// The exact signs of orientations, and an area good to about 1e-15 of itself.
//
// Deliberately not CGAL's predicates: the code under test uses those, and a checker that shares its predicate with
// what it checks shares its mistakes.
#pragma once

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// +1 where a, b, c turn counter-clockwise, -1 clockwise, 0 on one line: exact for the stored doubles, also where
/// products under- or overflow. Precondition: all coordinates are finite.
int orientation(const Point& a, const Point& b, const Point& c);

/// Across each other, or touching. Neither of zero length.
inline bool meet(const Segment& s, const Segment& t) {
  return orientation(s[0], s[1], t[0]) * orientation(s[0], s[1], t[1]) <= 0 &&
         orientation(t[0], t[1], s[0]) * orientation(t[0], t[1], s[1]) <= 0;
}

/// The same for two directions, each from the segment's start to its end: +1 where the second points to the left of the
/// first, 0 where they are parallel.
int turn(const Segment& first, const Segment& second);

/// Sum of the signed areas of all triangles. Error at most (#T + 8) 2^-64 times the sum over the triangles of the
/// product of two edge lengths (x87 long double; its exponents can't overflow here).
long double area(const Mesh& mesh);

}  // namespace cutbench::oracle
