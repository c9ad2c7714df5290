// The JSON reports of `cutbench cut` and `cutbench score`: the names are those of the columns of records
// (harness/records/metrics.h), units in the names; null: not measured.
#pragma once

#include <filesystem>
#include <string>

#include "harness/cut/cut_all.h"
#include "harness/files/whole_file.h"
#include "harness/judge/assessment.h"

namespace cutbench {

/// The report of `cutbench cut`. \param h  mean rest edge of the uncut sheet
/// \param pick_us  time to find the path in rest space
std::string cut_as_json(const std::string& method, const CutRun& run, double pick_us, const Assessment& assessment,
                        double h);
/// The same as a file, in its place after place(). Throws OutputError where it can't be written.
[[nodiscard]] WholeFile report_file(const std::filesystem::path& file, const std::string& method, const CutRun& run,
                                    double pick_us, const Assessment& assessment, double h);

/// The report of `cutbench score`. What could not be measured is null.
std::string score_as_json(const Assessment& assessment, double h);

}  // namespace cutbench
