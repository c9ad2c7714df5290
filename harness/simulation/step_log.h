// What each step of a simulation cost, with the cuts made before it.
#pragma once

#include <vector>

#include "harness/fem/time/step_report.h"

namespace cutbench {

/// Microseconds, steady clock. Writing frames, energies and budgets is not counted.
struct LoggedStep {
  bool has_cut = false;    ///< a cut, or a part of a blade's, was made before the step
  double geometry_us = 0;  ///< of the cuts: picks, path, mesh
  double update_us = 0;    ///< state of new vertices, elements, mass, loads and pattern of the system
  double bending_us = 0;   ///< bending rows
  StepReport step;
  double total_us() const { return geometry_us + update_us + bending_us + step.time_us.total(); }
};

}  // namespace cutbench
