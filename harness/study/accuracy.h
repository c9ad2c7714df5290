// Accuracy runs: problems with a known answer x sheets x resolutions x members of the ensemble x methods. Every cut
// sheet is judged, loaded, solved by each solver with each budget, and compared with the exact answer.
#pragma once

#include <vector>

#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "harness/study/variant.h"

namespace cutbench {

/// The method of the rows whose sheet was meshed anew to fit the cut: what excess errors are measured from. Its time of
/// a cut is that of the meshing.
constexpr const char* reference_method = "body_fitted (reference)";
/// A second one, graded at tips: a row beside the methods'.
constexpr const char* graded_method = "body_fitted_graded (reference)";

/// Writes <out>/<stem>/records.csv, a row per problem, sheet, resolution, member, method, solver and budget, and
/// context.json; a killed run goes on where it stopped. Prints the table. Returns false where a row's verdict is not
/// ok. \pre the experiment is an AccuracyStudy
bool run_accuracy(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                  const RunOptions& options);

/// The columns of its records; the first ones as in all records (harness/records/record.h). Solver, budget and tip
/// functions, too, say what was measured.
const std::vector<std::string>& accuracy_columns();

}  // namespace cutbench
