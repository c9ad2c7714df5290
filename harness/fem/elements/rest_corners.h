// Where the corners of a triangle are at rest, for its own metric: lengths, and nothing else.
#pragma once

#include <array>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// In a plane of the triangle's own: its corners in the sheet's chart. Of a sheet that is its own rest shape
/// (Sheet::unrolled()): as they lie in space at rest (Sheet::position()). That differs where a method moved a vertex or
/// swapped an edge over a crease. Where the triangle would lose most of its area so, as over a sharp fold, the chart.
std::array<Point2, 3> rest_corners(const Sheet& sheet, TriangleIndex t);

}  // namespace cutbench
