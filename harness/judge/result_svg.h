// A drawing of a cut that somebody made, for a report of a fault: the sheet before, the path, and the result at rest.
#pragma once

#include <span>
#include <string>

#include "harness/judge/findings.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// SVG of 800 points a side: the neighbourhood of the first finding's place, 4 h each way, with a ring round the place;
/// or the whole sheet. Edges of the sheet before are grey, the path is red, edges of the result are black and its open
/// edges blue; the text is the first finding. Coordinates that are not finite are left out.
std::string result_as_svg(const Sheet& before, const MeshData& result, std::span<const Curve> cuts,
                          std::span<const Finding> findings);

}  // namespace cutbench
