#pragma once

#include <filesystem>

#include "harness/base/whole_file.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"

namespace cutbench {

/// R.json of `cutbench cut`, in its place after place(). `pick_us`: what finding the path in rest space took. Throws
/// OutputError where it can't be written.
[[nodiscard]] WholeFile report_file(const std::filesystem::path& file, const std::string& method, const CutRun& run,
                                    double pick_us, const Assessment& assessment);

/// R.json of `cutbench score`: the same names where they mean the same, null where the result is too broken to measure.
void write_score(const std::filesystem::path& file, const Assessment& assessment);

}  // namespace cutbench
