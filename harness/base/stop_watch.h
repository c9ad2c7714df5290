// The clock of every phase.
#pragma once

#include <chrono>
#include <utility>

namespace cutbench {

/// Microseconds of the steady clock since the last lap.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::micro>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace cutbench
