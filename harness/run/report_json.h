#pragma once

#include <filesystem>

#include "harness/run/report.h"

namespace cutbench {

/// R.json of `cutbench cut`: written to a temporary file and renamed. Throws InputError where that fails.
void write_report(const std::filesystem::path& file, const std::string& method, const CutRun& run,
                  const Assessment& assessment);

}  // namespace cutbench
