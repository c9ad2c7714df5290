#include "experiments/advice/scene_trial.h"

#include <cmath>

#include "experiments/advice/scene_run.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

Scene scene_of(Scene scene, const Choice& choice) {
  scene.resolution = choice.resolution;
  scene.solver.name = choice.solver;
  if (scene.integrator != Integrator::equilibrium) set_steps(scene, choice.steps);
  return scene;
}

std::unique_ptr<CuttingMethod> method_of(const Choice& choice) {
  const MethodRow& row = find_method(choice.method);
  return row.make(row.parameter.value);
}

}  // namespace

SceneTrial SceneTrials::run(const Choice& choice, double tolerance, double time_limit) const {
  Scene scene = scene_of(scene_, choice);
  scene.solver.tolerance = tolerance;
  const auto method = method_of(choice);
  const SceneRun made = run_to_end(scene, *method, cut_, time_limit);
  return {.choice = choice,
          .verdict = made.verdict,
          .reason = made.reason,
          .value = quantity_ == Quantity::gape ? made.gape : made.deflection,
          .time_limit = time_limit};
}

void SceneTrials::time(SceneTrial& trial) const {
  const auto method = method_of(trial.choice);
  ++trial.timings;
  trial.ms_per_second =
      std::fmin(trial.ms_per_second, processor_ms_per_second(scene_of(scene_, trial.choice), *method, cut_));
}

}  // namespace cutbench
