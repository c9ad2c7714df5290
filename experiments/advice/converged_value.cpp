#include "experiments/advice/converged_value.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "experiments/advice/scene_run.h"
#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr double tight = 1e-5;  // tolerance of the solver

}  // namespace

ConvergedValue::ConvergedValue(const Scene& scene, std::string method, SheetLevels& sheets, const SceneTrials& runs,
                               double time_limit)
    : scene_(scene),
      method_(std::move(method)),
      sheets_(sheets),
      trials_(runs),
      time_limit_(time_limit),
      at_rest_(at_rest(scene)),
      fineness_(4 * sheets.own() <= most_triangles ? 2 : 1),
      steps_(at_rest_ ? 1 : 2 * to_int(steps_of(scene))),
      own_steps_(steps_of(scene)) {
  if (is_explicit(scene)) {
    own_steps_ = stable_steps(1);
    steps_ = 2 * stable_steps(fineness_);
  }
  if (!failed_.empty() || !has_sheets(fineness_) || !extrapolate(fineness_, steps_)) result_.missing = failed_;
}

bool ConvergedValue::has_sheets(double fineness) {
  if (sheets_.triangles(fineness) && sheets_.triangles(fineness / 2)) return true;
  failed_ = "there is no coarser sheet to extrapolate from: " + sheets_.missing();
  return false;
}

int ConvergedValue::stable_steps(double fineness) {
  const auto triangles = sheets_.triangles(fineness);
  const auto steps = triangles ? trials_.stable_steps(method_, *triangles) : std::nullopt;
  if (!steps) failed_ = method_ + " has no stable explicit step here; name another method first in --methods";
  return steps.value_or(1);
}

Choice ConvergedValue::choice_of(double fineness, int steps) const {
  return {.method = method_, .solver = "multigrid", .resolution = *sheets_.triangles(fineness), .steps = steps};
}

double ConvergedValue::value_of(double fineness, int steps) {
  const Choice choice = choice_of(fineness, steps);
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

bool ConvergedValue::extrapolate(double fineness, int steps) {
  const double coarser = value_of(fineness / 2, steps), slower = at_rest_ ? 0 : value_of(fineness, steps / 2);
  const double here = value_of(fineness, steps);
  if (!failed_.empty()) return false;
  // First order in the length of edges: strains grow like one over the root of the distance from a tip. First order in
  // the step, too, but for the midpoint rule.
  const double by_step = scene_.integrator == Integrator::midpoint ? 1.0 / 3 : 1;
  result_.from_mesh = here - coarser;
  result_.from_step = at_rest_ ? 0 : by_step * (here - slower);
  result_.value = here + result_.from_mesh + result_.from_step;
  result_.spread = std::abs(result_.from_mesh) + std::abs(result_.from_step);
  result_.finest = choice_of(fineness, steps);
  result_.missing = result_.value > 0 ? "" : "nothing moves, or opens, in the end";
  fineness_ = fineness;
  steps_ = steps;
  return true;
}

bool ConvergedValue::refine(double most_work) {
  if (!failed_.empty()) return false;
  const bool finer_mesh = std::abs(result_.from_mesh) >= std::abs(result_.from_step);
  const double fineness = finer_mesh ? 2 * fineness_ : fineness_;
  int steps = finer_mesh ? steps_ : 2 * steps_;
  if (finer_mesh && is_explicit(scene_)) steps = std::max(steps, 2 * stable_steps(fineness));
  const double work = fineness * fineness * steps / own_steps_;
  if (!failed_.empty() || work > most_work) return false;
  return extrapolate(fineness, steps);
}

}  // namespace cutbench
