#pragma once

#include <filesystem>

#include "harness/run/report.h"

namespace cutbench {

/// R.json of `cutbench cut`: written to a temporary file and renamed. Throws InputError where that fails.
void write_report(const std::filesystem::path& file, const std::string& method, const CutRun& run,
                  const Assessment& assessment);

/// R.json of `cutbench score`: the same names where they mean the same, null where the result is too broken to measure.
void write_score(const std::filesystem::path& file, const Assessment& assessment);

}  // namespace cutbench
