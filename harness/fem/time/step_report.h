// What one step came to, and what it cost.
#pragma once

#include <string>

#include "harness/base/verdict.h"

namespace cutbench {

/// Microseconds (steady clock), summed over the Newton iterations.
struct StepTimes {
  double rotate = 0;    ///< deformations, forces and right-hand side
  double assemble = 0;  ///< element matrices into the system
  double setup = 0;     ///< preconditioner or factorisation
  double solve = 0;
  double total() const { return rotate + assemble + setup + solve; }
};

struct StepReport {
  Verdict verdict = Verdict::ok;  ///< or solver_stalled, newton_failed, not_finite
  std::string reason;
  int newton = 0;       ///< linear solves
  int iterations = 0;   ///< of the linear solver, summed; of xpbd and vbd the sweeps
  double residual = 0;  ///< the largest that a linear solve left
  int fallbacks = 0;    ///< solves that another preconditioner ended (SolveReport::fell_back)
  /// Equilibrium: |f| over the scale of the forces. A step of three solves or more: the size of the last Newton step
  /// over that of the one before, in the norm of A; newton_failed where it is not smaller, and no rounding error. The
  /// first one is linearised elsewhere than the others and does not compare.
  double newton_residual = 0;
  StepTimes time_us;
};

}  // namespace cutbench
