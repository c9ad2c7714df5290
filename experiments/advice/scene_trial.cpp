#include "experiments/advice/scene_trial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/advice/scene_run.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

std::unique_ptr<CuttingMethod> method_of(const Choice& choice) {
  const MethodRow& row = find_method(choice.method);
  return row.make(row.parameter.value);
}

}  // namespace

Scene SceneTrials::scene_of(const Choice& choice) const {
  Scene scene = scene_;
  sheets_.apply(scene, choice.resolution);
  scene.solver.name = choice.solver;
  if (scene.integrator != Integrator::equilibrium) set_steps(scene, choice.steps);
  return scene;
}

std::optional<int> SceneTrials::stable_steps(const std::string& method, int triangles) const {
  Scene scene = scene_;
  sheets_.apply(scene, triangles);
  const auto cutting = method_of({.method = method, .solver = {}});
  try {
    const auto motion = Simulation::start(scene);
    const Sheet before = motion->posed_sheet();
    for (const Scene::Cut& cut : scene.cuts)
      if (const auto curves = curves_of(cut, before); !curves.empty()) motion->cut_now(curves, *cutting, cut_);
    const double limit = explicit_safety * motion->step_limits().with_bending;
    if (!(limit > 0)) return {};
    return std::max(1, to_int(std::ceil(end_of(scene) / limit)));
  } catch (const InputError&) {
    return {};
  }
}

SceneTrial SceneTrials::run(const Choice& choice, double tolerance, double time_limit) const {
  Scene scene = scene_of(choice);
  scene.solver.tolerance = tolerance;
  const auto method = method_of(choice);
  // Some take minutes, and nobody knows beforehand how many there will be.
  std::fprintf(stderr, "running %s, %s, %d triangles, %d steps\n", choice.method.c_str(), choice.solver.c_str(),
               choice.resolution, choice.steps);
  const SceneRun made = run_to_end(scene, *method, cut_, time_limit);
  return {.choice = choice,
          .verdict = made.verdict,
          .reason = made.reason,
          .value = quantity_ == Quantity::gape ? made.gape : made.deflection,
          .time_limit = time_limit,
          .free_pieces = made.free_pieces};
}

void SceneTrials::time(SceneTrial& trial) const {
  const auto method = method_of(trial.choice);
  ++trial.timings;
  trial.ms_per_second = std::fmin(trial.ms_per_second, processor_ms_per_second(scene_of(trial.choice), *method, cut_));
}

}  // namespace cutbench
