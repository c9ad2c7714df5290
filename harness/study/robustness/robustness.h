// The robustness run: adversarial cuts, over all sheets, by all methods and the cross-check, every one of them judged.
#pragma once

#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Runs it in processes of its own, so that a crash or a hang costs one case, and writes <out>/<stem>/records.csv, with
/// a row per sheet, method and family, context.json and failing/. What is counted depends on the experiment and the
/// shard alone, not on the number of processes. A killed robustness run goes on with the sheet and method it was at.
/// Prints the tables. Returns false where a method's cut failed, was wrong, crashed or was timed out; the cross-check's
/// don't count. \pre the experiment is a RobustnessStudy
bool run_robustness(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options);

/// The columns of its records; the first ones as in all records (harness/records/record.h).
const std::vector<std::string>& robustness_columns();

}  // namespace cutbench
