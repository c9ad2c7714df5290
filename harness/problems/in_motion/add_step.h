// What the steps of a simulated problem came to, in its answer.
#pragma once

#include <algorithm>

#include "harness/fem/time/step_report.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

/// Adds up times and linear solves, keeps the largest residual, and takes over the verdict.
inline void add_step(const StepReport& report, Answer& answer) {
  answer.assemble_us += report.time_us.rotate + report.time_us.assemble;
  answer.setup_us += report.time_us.setup;
  answer.solve_us += report.time_us.solve;
  answer.iterations += report.newton;
  answer.residual = std::max(answer.residual, report.residual);
  answer.verdict = report.verdict;
  answer.reason = report.reason;
}

}  // namespace cutbench
