#include "harness/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <optional>

#include "harness/base/conversions.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/time/stepper.h"
#include "harness/simulation/moving_sheet.h"
#include "harness/simulation/scene_cuts.h"
#include "harness/simulation/turned_over.h"

namespace cutbench {

namespace {

/// In space a share of slivers is turned over in any bent sheet, with no area and no harm.
constexpr double most_turned = 0.01;

std::string refusal(const SimulationOutcome& outcome, const MotionCut& first) {
  const std::string n = std::to_string(outcome.refused) + " of " + std::to_string(outcome.cuts) + " cuts ";
  return n + (outcome.refused == 1 ? "was refused: " : "were refused; the first: ") + first.reason;
}

template <int D>
class SceneInMotion : public Simulation {
 public:
  explicit SceneInMotion(const Scene& scene)
      : scene_(scene), now_(scene_), trial_(now_), cuts_(scene_, now_), stepper_(options_of(scene)) {
    now_.model.reserve_spare();
    trial_.model.reserve_spare();
  }

  const std::vector<MotionCut>& made_cuts() const override { return cuts_.made(); }
  const std::vector<LoggedStep>& steps() const override { return steps_; }
  const Sheet& sheet() const override { return now_.sheet; }
  Sheet posed_sheet() const override { return now_.posed(); }
  Sheet tried_sheet() const override { return trial_.posed(); }
  double time() const override { return now_.state.time; }
  void watch() override {
    watched_ = true;
    begin_budget();
  }
  const EnergyBudget* budget() const override { return budget_ ? &*budget_ : nullptr; }
  SimulationOutcome outcome() const override {
    SimulationOutcome outcome = outcome_;
    if (outcome.verdict == Verdict::ok) {
      outcome.steps = steps_.size();
      outcome.cuts = cuts_.made().size();
    }
    outcome.only_shapes = watched_ && sweeps(scene_.integrator);
    const MotionCut* first = nullptr;
    for (std::size_t i = 0; i < outcome.cuts; ++i) {
      if (cuts_.made()[i].cut.status != Status::refused) continue;
      ++outcome.refused;
      if (!first) first = &cuts_.made()[i];
    }
    if (first && outcome.verdict == Verdict::ok) outcome.reason = refusal(outcome, *first);
    return outcome;
  }
  void limit_time(double seconds) override {
    time_limit_ = seconds;
    stop_at_ = to_double(std::clock()) + seconds * CLOCKS_PER_SEC;
  }
  StepLimits step_limits() override {
    const Material& material = scene_.material;
    Elasticity elasticity{.poisson = material.poisson, .plane = scene_.physics.plane, .mass = scene_.physics.mass};
    if (const AddedMass* const added = now_.model.added_mass())
      elasticity.mass_limit = added->limit() * material.density / material.stiffness;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (now_.model.constrained() || scene_.physics.strain == Strain::springs) return {unknown, unknown};
    const Constraints constraints = now_.model.elements().merged();
    StepLimits limits;
    limits.membrane = explicit_step_limit(largest_eigenvalue(now_.sheet, constraints, elasticity), material);
    elasticity.bending = scene_.physics.bending;
    elasticity.bending_length2 = material.bending / material.stiffness;
    limits.with_bending = elasticity.bending == BendingKind::none
                              ? limits.membrane
                              : explicit_step_limit(largest_eigenvalue(now_.sheet, constraints, elasticity), material);
    return limits;
  }
  Balance balance() override { return now_.balance(); }

  StepReport advance(double time, CuttingMethod& method, const CutOptions& options) override {
    StepReport report;
    const double almost = time - 1e-9 * scene_.step;
    while (now_.state.time < almost && report.verdict == Verdict::ok) {
      if (cuts_.leave_out_far_parts()) begin_budget();
      if (const MotionCut* failed = cuts_.make_due(method, options, budget_ ? &*budget_ : nullptr)) {
        report.verdict = failed->verdict;
        report.reason = failed->reason;
      }
      if (report.verdict == Verdict::ok) report = step();
      if (report.verdict == Verdict::ok && to_double(std::clock()) >= stop_at_) {
        char text[64];
        std::snprintf(text, sizeof text, "the limit is %g s", time_limit_);
        report.verdict = Verdict::timed_out;
        report.reason = text;
      }
    }
    end_where_bad(report);
    return report;
  }

  StepReport step() override {
    if (budget_) before_ = now_.state;
    StepReport report = stepper_.step(now_.model, now_.state);
    if (budget_ && report.verdict == Verdict::ok) {
      const SystemMatrix<D> damping = stepper_.damping_matrix(now_.model);
      budget_->add_step(now_.model, before_, now_.state, scene_.step, &damping);
    }
    steps_.push_back(cuts_.take_log());
    if (watched_ && report.verdict == Verdict::ok) judge_state(report);
    steps_.back().step = report;
    end_where_bad(report);
    return report;
  }

  MotionCut cut_now(std::span<const Curve> curves, CuttingMethod& method, const CutOptions& options) override {
    return cuts_.make_now(curves, method, options, budget_ ? &*budget_ : nullptr);
  }

  void pull(std::span<const double> force) override {
    const auto finite = [](double f) { return std::isfinite(f); };
    const std::size_t vertices = now_.sheet.deformed_slots();
    if (!force.empty() && force.size() != D * vertices)
      throw InputError(scene_.stem + ": " + std::to_string(force.size()) + " forces; give " + std::to_string(D) +
                       " for each of the " + std::to_string(vertices) + " vertices");
    if (!std::all_of(force.begin(), force.end(), finite)) throw InputError(scene_.stem + ": a force is not finite");
    force_.assign(force.begin(), force.end());
    change_from_outside([&] { now_.model.set_pins_and_force(now_.sheet, now_.pins, force_); });
  }

  void hold(const std::vector<Pin>& pins) override {
    change_from_outside([&] {
      now_.pins = pins;
      now_.model.set_pins_and_force(now_.sheet, now_.pins, force_);
      const Field dv = now_.state.dv;  // no vertex has another number
      hold_where_it_is(now_.model, now_.state);
      now_.state.dv = dv;
    });
    hold_constrained_vertices(now_.pins, {}, now_.sheet);
  }

  std::span<const double> positions() const override { return of_sheet(now_.state.x); }
  std::span<const double> velocities() const override { return of_sheet(now_.state.v); }

  MotionCut try_cut(const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                    const CutOptions& options) override {
    trial_ = now_;  // into the room that is there
    const StepReport last = stepper_.step(trial_.model, trial_.state);
    const State at_last = trial_.state;
    MotionCut result = cuts_.cut(trial_, cuts, cutter, method, options);
    if (result.verdict != Verdict::ok) return result;
    const State at_cut = trial_.state;
    result.first_step = stepper_.step(trial_.model, trial_.state);
    for (const StepReport& step : {last, result.first_step})
      if (step.verdict != Verdict::ok) {
        result.verdict = step.verdict;
        result.reason = step.reason;
      }
    // The balances come last: looking at the model before would have warmed it up.
    result.before = balance_of(now_.model, at_last);
    result.after = balance_of(trial_.model, at_cut);
    return result;
  }

 private:
  static StepOptions options_of(const Scene& scene) {
    return {scene.integrator, scene.step, scene.newton, scene.sweeps, scene.solver, scene.robust};
  }

  /// Without phantom nodes.
  std::span<const double> of_sheet(const Field& field) const { return {field.data(), D * now_.sheet.deformed_slots()}; }

  /// By the user, who may set other pins and forces.
  template <class Change>
  void change_from_outside(Change change) {
    if (!budget_) return change();
    const Balance before = balance();
    change();
    budget_->add_work(before, balance());
  }

  void end_where_bad(const StepReport& report) {
    if (report.verdict != Verdict::ok) conclude(report.verdict, report.reason);
  }

  void conclude(Verdict verdict, const std::string& reason) {
    const bool is_first = outcome_.verdict == Verdict::ok;
    outcome_.verdict = verdict;
    outcome_.reason = reason;
    outcome_.time = now_.state.time;
    if (!is_first) return;  // no more steps count than before
    outcome_.steps = steps_.size();
    outcome_.cuts = cuts_.made().size();
    if (budget_) budget_->stop_judging();
  }

  /// \pre the step is in the budget, where one is kept.
  void judge_state(StepReport& report) {
    const Energy energy = budget_ ? budget_->rows().back().energy : balance().energy;
    if (!std::isfinite(energy.total()) || !std::isfinite(energy.kinetic)) {
      report.verdict = Verdict::not_finite;
      report.reason = "the energy";
      return;
    }
    if (outcome_.verdict != Verdict::ok) return;  // the first fault counts
    const TurnedOver turned = turned_over(now_.sheet, now_.model.elements(), now_.state.x, D);
    const bool inverted = D == 2 ? turned.triangles > 0 : turned.area > most_turned;
    char text[96];
    std::snprintf(text, sizeof text, "%zu triangles, %.2g %% of the rest area, are turned over", turned.triangles,
                  100 * turned.area);
    if (inverted) return conclude(Verdict::inverted, text);
    if (const std::string fault = budget_ ? budget_->fault() : ""; !fault.empty())
      conclude(Verdict::energy_growth, fault);
  }

  void begin_budget() {
    const double strain = now_.sheet.seams().empty() ? 1e-10 : seam_rounding;  // that is rounding
    const double area = now_.model.lumped_mass().sum() / scene_.material.density;
    const double noise = strain * strain * scene_.material.stiffness * area;
    if (watched_ && keeps_budget(scene_.integrator))
      budget_.emplace(balance(), scene_.integrator, noise, now_.state.time, scene_.robust);
  }

  Scene scene_;
  MovingSheet<D> now_, trial_;
  SceneCuts<D> cuts_;
  Stepper<D> stepper_;
  bool watched_ = false;
  std::optional<EnergyBudget> budget_;
  State before_;  // the step, for the budget
  SimulationOutcome outcome_;
  double time_limit_ = 0, stop_at_ = std::numeric_limits<double>::infinity();  // s; ticks of std::clock()
  std::vector<LoggedStep> steps_;
  std::vector<double> force_;  // of pull()
};

}  // namespace

std::string SimulationOutcome::text() const {
  std::string text = name_of(verdict);
  char when[32];
  std::snprintf(when, sizeof when, " at %.4g s: ", time);
  if (verdict != Verdict::ok) return text + when + reason;
  if (!reason.empty()) text += ", but " + reason;
  return only_shapes ? text + "; by its shapes alone: no energy is judged where steps are sweeps" : text;
}

std::unique_ptr<Simulation> Simulation::start(const Scene& scene) {
  if (scene.physics.dimension == 2) return std::make_unique<SceneInMotion<2>>(scene);
  return std::make_unique<SceneInMotion<3>>(scene);
}

}  // namespace cutbench
