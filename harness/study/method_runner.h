// The run loop of cut families: sheets x resolutions x cases x methods x repetitions, a row each.
#pragma once

#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Writes <out>/<stem>/records.csv and context.json; a killed run goes on where it stopped. Prints the results table.
/// Returns false where a row's verdict is not ok. Without times the cuts are made in processes of their own, and one
/// that crashes or hangs is a row with that verdict. \pre the experiment is a CutStudy
bool run_methods(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                 const RunOptions& options);

}  // namespace cutbench
