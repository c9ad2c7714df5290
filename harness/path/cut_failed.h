// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "harness/base/verdict.h"

namespace cutbench {

/// What a method (or the coordinates) can't do: the cut failed and the sheet is rolled back.
struct CutFailed : std::runtime_error {
  /// `why`: one line, of a program's result a second one with the mend.
  CutFailed(Verdict what, const std::string& why) : std::runtime_error(why), verdict(what) {}
  Verdict verdict;
};

/// What a method can't be asked for, as it finds while it cuts: the sheet is rolled back and the cut is refused.
/// `why`: one line that also says what to do.
struct CutRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Points are too close together for doubles: one that was rounded fell out of its triangle, or a path became two edges
/// that cross. The sheet is rolled back, and the path embedded in another way (embed_carefully.h) before anything
/// fails.
struct TooClose : CutFailed {
  explicit TooClose(const std::string& why) : CutFailed(Verdict::inverted, why) {}
};

}  // namespace cutbench
