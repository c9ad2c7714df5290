// Local dynamics: once a sheet is cut, only what is near its cuts moves, and the rest is left out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/fem/elements/physics.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// Throws InputError, which begins with `name`, where the radius is less than the longest edge: triangles that a cut
/// crosses might be left out.
void check_radius_spans_edges(const Sheet& sheet, double radius, const std::string& name);

struct ActiveRegion {
  std::vector<TriangleIndex> outside;  ///< left out
  std::vector<Pin> pins;               ///< each a vertex that is kept, and stays where it is
};

/// Vertices move that are no farther than `radius` (rest units) from a curve, or between it and its chord: what a cut
/// parts from the sheet moves. Round them two rings of vertices are kept and held, so that slopes are held, too.
/// Nothing is left out, and nothing held, where no vertex is near. Looks at everything. \pre check_radius_spans_edges()
ActiveRegion active_region(const Sheet& sheet, std::span<const Curve> curves, double radius);

}  // namespace cutbench
