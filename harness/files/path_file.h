// Path files: what harness/path/path_text.h reads and writes, as files.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/path/path_text.h"

namespace cutbench {

/// \throw InputError
std::vector<Curve> read_path(const std::filesystem::path& file);
std::vector<AnyCurve> read_path_with_picks(const std::filesystem::path& file);

/// Whole or not at all. \throw OutputError
void write_path(const std::vector<Curve>& cuts, const std::filesystem::path& file);

}  // namespace cutbench
