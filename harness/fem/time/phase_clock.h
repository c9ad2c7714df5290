// The time of a part of a step.
#pragma once

#include <chrono>

namespace cutbench {

/// Adds the microseconds of its life to a phase.
class PhaseClock {
 public:
  explicit PhaseClock(double& phase) : phase_(phase) {}
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;
  ~PhaseClock() {
    phase_ += std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& phase_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace cutbench
