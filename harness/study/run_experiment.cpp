#include "harness/study/run_experiment.h"

#include "harness/study/accuracy.h"
#include "harness/study/method_runner.h"
#include "harness/study/robustness/robustness.h"
#include "harness/study/stability/stability.h"

namespace cutbench {

bool run_experiment(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options) {
  if (experiment.robustness) return run_robustness(experiment, methods, context, options);
  if (experiment.accuracy) return run_accuracy(experiment, methods, context, options);
  if (experiment.stability) return run_stability(experiment, methods, context, options);
  return run_methods(experiment, methods, context, options);
}

}  // namespace cutbench
