// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace cutbench {

/// What a method (or the coordinates) can't do: the cut failed and the sheet is rolled back.
struct CutFailed : std::runtime_error {
  /// `name`: of the verdict, such as not_terminated or inverted (results/README.md); `why`: one
  /// line, of a program's result a second one with the mend.
  CutFailed(std::string name, const std::string& why) : std::runtime_error(why), verdict(std::move(name)) {}
  std::string verdict;
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
  explicit TooClose(const std::string& why) : CutFailed("inverted", why) {}
};

}  // namespace cutbench
