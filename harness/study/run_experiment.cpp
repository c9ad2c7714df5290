#include "harness/study/run_experiment.h"

#include "harness/study/stability/atlas.h"
#include "harness/study/robustness/campaign.h"
#include "harness/study/accuracy.h"
#include "harness/study/method_runner.h"

namespace cutbench {

bool run_experiment(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options) {
  if (experiment.campaign) return run_campaign(experiment, methods, context, options);
  if (experiment.accuracy) return run_accuracy(experiment, methods, context, options);
  if (experiment.atlas) return run_atlas(experiment, methods, context, options);
  return run_methods(experiment, methods, context, options);
}

}  // namespace cutbench
