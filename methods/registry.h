// The table of all methods: what `cutbench methods` lists, and what tests, experiments and plots go through.
#pragma once

#include <vector>

#include "harness/cut/method_row.h"

namespace cutbench {

const std::vector<MethodRow>& all_methods();

/// Adds rows of methods that are not in this tree. To be called while nobody keeps a row of the table. Throws
/// InputError: a name that is there.
void add_methods(const std::vector<MethodRow>& more);

/// These and their variants (methods/variants.h): every name that find_method() knows.
const std::vector<MethodRow>& nameable_methods();

/// Throws InputError that lists the names in the table.
const MethodRow& find_method(const std::string& name);

}  // namespace cutbench
