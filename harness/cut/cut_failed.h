// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace cutbench {

/// What a method (or the coordinates) can't do: the cut failed and the sheet is rolled back.
struct CutFailed : std::runtime_error {
  /// `verdict`: not_terminated, inverted, leak, ... (results/README.md); `why`: one line.
  CutFailed(std::string verdict_, const std::string& why) : std::runtime_error(why), verdict(std::move(verdict_)) {}
  std::string verdict;
};

}  // namespace cutbench
