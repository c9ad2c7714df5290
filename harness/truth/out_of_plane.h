// Problems of a sheet that leaves its plane: bending beside a cut.
#pragma once

#include "harness/fem/physics.h"
#include "harness/truth/problem.h"

namespace cutbench {

// Each with a bending energy other than `patches` to show what a wrong one does.
std::unique_ptr<const Problem> bending_patch_slit(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> slit_strip(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> flap(BendingKind bending = BendingKind::patches);
std::unique_ptr<const Problem> trouser_tear(BendingKind bending = BendingKind::patches);

void append_out_of_plane(std::vector<std::unique_ptr<const Problem>>& problems);

}  // namespace cutbench
