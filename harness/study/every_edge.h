// The paper's wording taken literally: "intersection detection will operate between the cut path and each edge of
// triangles of the mesh" (Xin et al. 2018, 4.1.1). The honest baseline: measured in the same run as everything else, on
// the same machine.
#pragma once

#include <cstddef>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// Intersections of the curve with the edges of the sheet, each edge tested against each cubic Bezier by solving for
/// its crossings with the edge's line (closed form: Cardano, and the trigonometric one where there are three). Only
/// counts: nothing is cut. \pre the curve is a Bezier.
std::size_t count_crossings_by_every_edge(const Sheet& sheet, const Curve& curve);

}  // namespace cutbench
