// The table of all methods: what `cutbench methods` lists, and what tests, experiments and plots go through.
#pragma once

#include <vector>

#include "harness/cut/cutting_method.h"

namespace cutbench {

const std::vector<MethodRow>& all_methods();

/// What warp_and_refine consists of, in every combination: "ablation:BEFORE:AFTER", where BEFORE the split comes
/// nothing, snap, warp, thin or warp+thin, and AFTER it nothing, flips, smoothing (flips, too), refine (all of them) or
/// tie. For experiments that name them; not in the table.
const std::vector<MethodRow>& ablation_methods();

/// Both: whatever may be named.
const std::vector<MethodRow>& nameable_methods();

/// Throws InputError that lists the names in the table.
const MethodRow& find_method(const std::string& name);

}  // namespace cutbench
