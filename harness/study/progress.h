// How far a run is and how long it will take.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

/// ", about 3 min left at this rate" where the cases done so far say something about the rest: at least 5 % of them and
/// 5 s of work. Cases need not cost the same: an experiment's finer sheets come later, and then the estimate grows.
inline std::string time_left(double seconds, std::size_t done, std::size_t total) {
  if (seconds < 5 || done == 0 || done >= total || 20 * done < total) return "";
  const double left = seconds * to_double(total - done) / to_double(done);
  const auto rounded = [](double value) { return std::to_string(std::lround(value)); };
  return ", about " +
         (left < 90     ? rounded(left) + " s"
          : left < 5400 ? rounded(left / 60) + " min"
                        : rounded(left / 3600) + " h") +
         " left at this rate";
}

/// One line that is written over on a terminal, a line every ten percent otherwise. On standard error.
class Progress {
 public:
  Progress(std::string name, std::size_t total, bool quiet) : name_(std::move(name)), total_(total), quiet_(quiet) {}
  void step(std::size_t n = 1) {
    done_ += n;
    show();
  }
  /// Cases that an earlier run has recorded: they count as done but say nothing about the time that is left.
  void skip(std::size_t n) {
    skipped_ += n;
    step(n);
  }
  /// `under_way`: so many more have begun.
  void show(std::size_t under_way = 0) {
    const std::size_t reached = done_ + under_way, percent = 100 * reached / std::max<std::size_t>(1, total_);
    if (quiet_ || percent == shown_ || (!terminal_ && percent / 10 == shown_ / 10)) return;
    shown_ = percent;
    const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::string left = reached > skipped_ ? time_left(seconds, reached - skipped_, total_ - skipped_) : "";
    constexpr const char* over = "\r\033[K";  // to the line's start, and erase it
    std::fprintf(stderr, "%s%s: %3zu %% of %zu cases, %.0f s%s%s", terminal_ ? over : "", name_.c_str(), percent,
                 total_, seconds, left.c_str(), terminal_ && percent < 100 ? "" : "\n");
  }

 private:
  std::string name_;
  std::size_t total_, done_ = 0, skipped_ = 0, shown_ = 0;
  bool quiet_, terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace cutbench
