// The table of all methods: what `cutbench methods` lists, and what tests, experiments and plots go through.
#pragma once

#include <vector>

#include "harness/cut/method_row.h"

namespace cutbench {

const std::vector<MethodRow>& all_methods();

/// Adds rows of methods that are not in this tree. To be called while nobody keeps a row of the table. Throws
/// InputError: a name that is there.
void add_methods(const std::vector<MethodRow>& more);

/// The steps of warp_and_refine in every constraint_matrix, named "ablation:BEFORE:AFTER". BEFORE is the step before
/// the split: nothing, snap, warp, thin or warp+thin. AFTER is the last step after it: nothing, flips, smoothing (with
/// flips), refine (with both) or constraint. For experiments that name them; not in all_methods().
const std::vector<MethodRow>& ablation_methods();

/// Both, and variants of phantom_node: every name that find_method() knows.
const std::vector<MethodRow>& nameable_methods();

/// Throws InputError that lists the names in the table.
const MethodRow& find_method(const std::string& name);

}  // namespace cutbench
