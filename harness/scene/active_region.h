// Local dynamics: once a sheet is cut, only what is near its cuts moves, and the rest is left out.
#pragma once

#include <span>
#include <vector>

#include "harness/fem/physics.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

struct ActiveRegion {
  std::vector<TriangleIndex> outside;  ///< left out; empty: nothing, as no vertex is so far, or none is near
  std::vector<Pin> pins;               ///< round it, each a vertex: what stays where it is
};

/// Vertices no farther than `radius` (rest units) from a curve, or inside a closed one, move. Round them two rings of vertices stay and are held,
/// so that slopes are held, too. Looks at everything.
ActiveRegion active_region(const Sheet& sheet, std::span<const Curve> curves, double radius);

}  // namespace cutbench
