// Faces of more than three corners as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

/// Triangles of a polygon, as positions in `corners`, which go round in its order. Of the two triangulations of a
/// quadrilateral the one with the shorter diagonal is taken, of other polygons ears, the one with the shortest diagonal
/// first. Exact, on the corners' coordinates in the plane of two axes that the polygon is the least steep to. O(n^2).
/// Empty: it has no area or crosses itself there. \pre at least three corners
std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<Point3>& corners);

}  // namespace cutbench
