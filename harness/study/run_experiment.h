// Any experiment, whatever kind of study it is.
#pragma once

#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Runs the experiment by its kind, and writes <out>/<stem>/records.csv and context.json; a killed run goes on where it
/// stopped. Prints the results table. Returns false where a row's verdict is not ok.
bool run_experiment(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options);

}  // namespace cutbench
