// The table of all methods: what `cutbench methods` lists, and what tests, experiments and plots go through.
#pragma once

#include <vector>

#include "harness/cut/cutting_method.h"

namespace cutbench {

const std::vector<MethodRow>& all_methods();

/// Throws InputError that lists the known names.
const MethodRow& find_method(const std::string& name);

}  // namespace cutbench
