// Where a cut comes in through the border, the displacements that a field prescribes there jump. A method may open the
// border beside the place that was asked for. The jump must be where the border is open: otherwise an edge of it is
// torn, and no mesh converges.
#pragma once

#include "harness/fem/constraints/constraint_matrix.h"
#include "harness/mesh/sheet.h"
#include "harness/problems/common/elastic_field.h"

namespace cutbench {

/// The displacement of williams_field() at each deformed vertex of the border, two coordinates each; 0 elsewhere.
/// Along the border, from one side of the opened place to the other, the angle round the origin is followed without a
/// jump. Beyond the cut that was asked for the field is continued: it is odd in the square root of z, so there it has
/// the other sign. Where the border was not opened, the jump is at the cut that was asked for.
/// \pre no edge of the border goes through the origin of the field.
Field continued_over_the_mouth(const ElasticField& field, const Sheet& sheet);

}  // namespace cutbench
