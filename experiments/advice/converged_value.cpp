#include "experiments/advice/converged_value.h"

#include <cmath>
#include <utility>

#include "experiments/advice/scene_run.h"
#include "harness/base/conversions.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

constexpr double tight = 1e-5;  // tolerance of the solver

}  // namespace

ConvergedValue::ConvergedValue(const Scene& scene, std::string method, const SceneTrials& runs, double time_limit)
    : scene_(scene),
      method_(std::move(method)),
      trials_(runs),
      time_limit_(time_limit),
      at_rest_(at_rest(scene)),
      side_(2 * squares_per_side(scene.resolution)),
      steps_(at_rest_ ? 1 : 2 * to_int(steps_of(scene))) {
  if (!extrapolate(side_, steps_)) result_.missing = failed_;
}

Choice ConvergedValue::choice_of(int side, int steps) const {
  return {.method = method_, .solver = "multigrid", .resolution = 2 * side * side, .steps = steps};
}

double ConvergedValue::value_of(int side, int steps) {
  const Choice choice = choice_of(side, steps);
  for (const SceneTrial& made : result_.runs)
    if (made.choice.resolution == choice.resolution && made.choice.steps == steps) return made.value;
  if (!failed_.empty()) return std::numeric_limits<double>::quiet_NaN();
  result_.runs.push_back(trials_.run(choice, tight, time_limit_));
  const SceneTrial& made = result_.runs.back();
  if (made.verdict != Verdict::ok)
    failed_ = "its run with " + std::to_string(choice.resolution) + " triangles and " + std::to_string(steps) +
              " steps ended as " + name_of(made.verdict) + ": " + made.reason;
  return made.value;
}

bool ConvergedValue::extrapolate(int side, int steps) {
  const double coarser = value_of(side / 2, steps), slower = at_rest_ ? 0 : value_of(side, steps / 2);
  const double here = value_of(side, steps);
  if (!failed_.empty()) return false;
  // First order in the length of edges: strains grow like one over the root of the distance from a tip. First order in
  // the step, too, but for the midpoint rule.
  const double by_step = scene_.integrator == Integrator::midpoint ? 1.0 / 3 : 1;
  result_.from_mesh = here - coarser;
  result_.from_step = at_rest_ ? 0 : by_step * (here - slower);
  result_.value = here + result_.from_mesh + result_.from_step;
  result_.spread = std::abs(result_.from_mesh) + std::abs(result_.from_step);
  result_.finest = choice_of(side, steps);
  result_.missing = result_.value > 0 ? "" : "nothing moves, or opens, in the end";
  side_ = side;
  steps_ = steps;
  return true;
}

bool ConvergedValue::refine(double most_work) {
  if (!failed_.empty()) return false;
  const bool finer_mesh = std::abs(result_.from_mesh) >= std::abs(result_.from_step);
  const double n = squares_per_side(scene_.resolution);
  const double work = (finer_mesh ? 4.0 : 2.0) * side_ * side_ * steps_ / (n * n * steps_of(scene_));
  if (work > most_work) return false;
  return finer_mesh ? extrapolate(2 * side_, steps_) : extrapolate(side_, 2 * steps_);
}

}  // namespace cutbench
