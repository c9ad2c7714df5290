// The robustness campaign: cuts of the mixture, over all sheets, by all methods and the peer, every one of them judged.
#pragma once

#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Runs it in processes of its own, so that a crash or a hang costs one case, and writes <out>/<stem>/records.csv, with
/// a row per sheet, method and family, context.json and failing/. What is counted depends on the experiment and the
/// shard alone, not on the number of processes. A killed campaign goes on with the sheet and method it was at. Prints
/// the tables. Returns false where a method's cut failed, was wrong, crashed or was timed out; the peer's don't count.
/// \pre experiment.campaign
bool run_campaign(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                  const RunOptions& options);

/// The columns of its records; the first ones as in all records (harness/records/record.h).
const std::vector<std::string>& campaign_columns();

}  // namespace cutbench
