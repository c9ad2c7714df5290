// Methods of the table in another form, for experiments that name them. The command line does not list them.
#pragma once

#include <vector>

#include "harness/cut/method_row.h"

namespace cutbench {

/// The steps of warp_and_refine in every combination, named "ablation:BEFORE:AFTER". BEFORE is the step before the
/// split: nothing, snap, warp, thin or warp+thin. AFTER is the last step after it: nothing, flips, smoothing (with
/// flips), refine (with both) or tie.
const std::vector<MethodRow>& ablation_methods();

/// Adds rows named "METHOD:WHAT": a constant that is no parameter of the method, or a step read otherwise.
/// \pre  the methods are in `all`: their promises are the variants' own
void append_variants(std::vector<MethodRow>& all);

}  // namespace cutbench
