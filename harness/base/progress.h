// How far a run is, for people who wait.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

namespace cutbench {

/// A bar on a terminal, a line every ten percent otherwise.
class Progress {
 public:
  Progress(std::string name, std::size_t total, bool quiet) : name_(std::move(name)), total_(total), quiet_(quiet) {}
  void step(std::size_t n = 1) {
    done_ += n;
    show();
  }
  /// `under_way`: so many more have begun.
  void show(std::size_t under_way = 0) {
    const std::size_t percent = 100 * (done_ + under_way) / std::max<std::size_t>(1, total_);
    if (quiet_ || percent == shown_ || (!terminal_ && percent / 10 == shown_ / 10)) return;
    shown_ = percent;
    const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::fprintf(stderr, "%s%s: %3zu %% of %zu cases, %.0f s%s", terminal_ ? "\r" : "", name_.c_str(), percent, total_,
                 seconds, terminal_ && percent < 100 ? "" : "\n");
  }

 private:
  std::string name_;
  std::size_t total_, done_ = 0, shown_ = 0;
  bool quiet_, terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace cutbench
