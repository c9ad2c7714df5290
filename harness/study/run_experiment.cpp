#include "harness/study/run_experiment.h"

#include "harness/study/accuracy.h"
#include "harness/study/method_runner.h"
#include "harness/study/robustness/robustness.h"
#include "harness/study/stability/stability.h"

namespace cutbench {

namespace {

using StudyFunction = bool (*)(const Experiment&, const std::vector<MethodRow>&, const Context&, const RunOptions&);

struct RunOfKind {
  StudyFunction operator()(const CutStudy&) const { return run_methods; }
  StudyFunction operator()(const AccuracyStudy&) const { return run_accuracy; }
  StudyFunction operator()(const RobustnessStudy&) const { return run_robustness; }
  StudyFunction operator()(const StabilityStudy&) const { return run_stability; }
};

}  // namespace

bool run_experiment(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options) {
  const StudyFunction run = std::visit(RunOfKind(), experiment.study);
  return run(experiment, methods, context, options);
}

}  // namespace cutbench
