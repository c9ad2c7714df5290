// The stability sweeps: sweeps to where the methods fail, every point in a process of its own.
#pragma once

#include <string>
#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Runs the sweeps and writes <out>/<stem>/records.csv, with a row per point, method, sheet and case, and context.json.
/// A point that crashes or hangs has the verdict `crashed` or `timed_out`. A killed run goes on where it was. Prints
/// how many points of each sweep had which verdict. Failures are what it is for: returns false only where a cut itself
/// failed, was wrong, crashed or was timed out.
/// \pre the experiment is a StabilityStudy
bool run_stability(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                   const RunOptions& options);

/// The columns of its records; so many of the first ones say what was tried.
const std::vector<std::string>& stability_columns();
std::size_t stability_key_columns();

}  // namespace cutbench
