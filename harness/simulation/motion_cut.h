// What came of a cut in a moving sheet, and what it cost.
#pragma once

#include <cstddef>
#include <string>

#include "harness/base/verdict.h"
#include "harness/cut/cut_all.h"
#include "harness/fem/model/energy.h"
#include "harness/fem/time/step_report.h"

namespace cutbench {

/// Times in microseconds, steady clock; nothing is warmed up.
struct MotionCut {
  CutRun cut;
  Verdict verdict = Verdict::ok;  ///< of the cut and of the steps before and after it
  std::string reason;
  std::size_t parts = 0;   ///< a blade cuts one part in each step; the times below are sums over the parts
  double pick_us = 0;      ///< building the tree of the deformed sheet, and carrying the picks to rest space
  double transfer_us = 0;  ///< state of new vertices
  double pattern_us = 0;   ///< element data, mass, loads and the pattern of the system
  double bending_us = 0;   ///< stencils and rows of the bending matrix
  StepReport first_step;
  /// Right before and after the cut. Of a blade's cut, `after` contains the sum of all jumps, without the motion
  /// between.
  Balance before, after;
};

}  // namespace cutbench
