// Problems of a sheet that leaves its plane: bending beside a cut. SI units. What each compares with, formula and
// source, is at the top of its .cpp; the elastica's numbers are in heavy_elastica.h.
//
// "Solved" is Newton's decrement at 1e-8 of the energy or less (Stepper), not a small residual: forces of slivers
// cancel no better than 1e-5 to 1e-3 of the whole in doubles. Where slivers keep Newton from that, too, the row has
// failed.
#pragma once

#include "harness/fem/elements/physics.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

// Each with a bending energy other than `patches` to show what a wrong one does.
std::unique_ptr<const Problem> bending_patch_slit(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> slit_strip(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> flap(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> trouser_tear(BendingKind bending = BendingKind::patches);

}  // namespace cutbench
