#include "harness/scene/simulation.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <optional>

#include "harness/base/stop_watch.h"
#include "harness/fem/largest_eigenvalue.h"
#include "harness/mesh/one_ring.h"
#include "harness/path/blade.h"
#include "harness/scene/active_region.h"
#include "harness/scene/turned_over.h"

namespace cutbench {

namespace {

/// The membrane's stiffness as most codes assemble it: a list of scalar entries, sorted and summed by the library.
template <int D>
double time_triplets(const Model<D>& model) {
  StopWatch watch;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(9 * D * D) * model.elements().size());
  const MembraneLaw law = law_of(model.material(), model.physics());
  for (std::size_t e = 0; e < model.elements().size(); ++e) {
    const Element& element = model.elements()[e];
    if (!element.alive()) continue;
    const ElementStiffness<D> k(element, model.deformation(e), law);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const auto block = k.block(i, j);
        for (int c = 0; c < D; ++c)
          for (int r = 0; r < D; ++r)
            entries.emplace_back(D * element.vertex[i].value + r, D * element.vertex[j].value + c,
                                 block[static_cast<std::size_t>(D * c + r)]);
      }
  }
  const auto n = static_cast<Eigen::Index>(D * model.vertices());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return watch.lap();
}

/// A blade's tip on its way leaves no slivers: it waits while it is nearer to an edge than this (but not on it), for as
/// long as one h at most; in mean rest edges h.
constexpr double clear_of_edges = 0.05;

/// In space a share of slivers is turned over in any bent sheet, with no area and no harm.
constexpr double most_turned = 0.01;

/// How far the nearest edge is that the point doesn't lie on, rest units. Cost: the whole mesh, outside every clock.
double distance_to_edges(const Sheet& sheet, Point2 p) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    const auto corners = sheet.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const double d2 = squared_distance(p, corners[k], corners[(k + 1) % 3]);
      if (d2 > sheet.snap() * sheet.snap()) nearest2 = std::min(nearest2, d2);
    }
  }
  return std::sqrt(nearest2);
}

template <int D>
class SceneInMotion : public Simulation {
 public:
  explicit SceneInMotion(const Scene& scene)
      : scene_(scene), now_(scene), trial_(now_), before_cuts_(now_.sheet), stepper_(options_of(scene)) {
    now_.model.reserve_spare(), trial_.model.reserve_spare();
    check_radius_spans_edges(now_.sheet, scene.active_radius, scene.stem);
    for (const auto& cut : scene.cuts)
      cuts_.push_back({cut.time, cut.speed, curves_of(cut, now_.sheet), cut.picked, {}, 0});
  }

  const std::vector<MotionCut>& made_cuts() const override { return made_; }
  const std::vector<LoggedStep>& steps() const override { return steps_; }
  const Sheet& sheet() const override { return now_.sheet; }
  Sheet posed_sheet() const override {
    Sheet posed = now_.sheet;
    for (std::size_t v = 0; v < posed.deformed_slots(); ++v) {
      const auto x = now_.state.x.template segment<D>(static_cast<Eigen::Index>(D * v));
      posed.set_position(DeformedIndex(v), {x[0], x[1], D == 3 ? x[D - 1] : 0});
    }
    return posed;
  }
  double time() const override { return now_.state.time; }
  void watch() override {
    watched_ = true;
    begin_budget();
  }
  const EnergyBudget* budget() const override { return budget_ ? &*budget_ : nullptr; }
  const SimulationVerdict& verdict() const override { return verdict_; }
  void limit_time(double seconds) override {
    time_limit_ = seconds, stop_at_ = static_cast<double>(std::clock()) + seconds * CLOCKS_PER_SEC;
  }
  StepLimits step_limits() override {
    const Material& material = scene_.material;
    Elasticity elasticity{.poisson = material.poisson, .plane = scene_.physics.plane, .mass = scene_.physics.mass};
    if (const AddedMass* const added = now_.model.added_mass())
      elasticity.mass_limit = added->limit() * material.density / material.stiffness;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (now_.model.tied() || scene_.physics.strain == Strain::springs) return {unknown, unknown};
    const Ties ties{.polygons = now_.model.polygons()};
    StepLimits limits;
    limits.membrane = explicit_step_limit(largest_eigenvalue(now_.sheet, ties, elasticity), material);
    elasticity.bending = scene_.physics.bending;
    elasticity.bending_length2 = material.bending / material.stiffness;
    limits.with_bending = elasticity.bending == BendingKind::none
                              ? limits.membrane
                              : explicit_step_limit(largest_eigenvalue(now_.sheet, ties, elasticity), material);
    return limits;
  }
  Balance balance() override { return balance_of(now_.model, now_.state); }

  StepReport advance(double time, CuttingMethod& method, const CutOptions& options) override {
    StepReport report;
    const double almost = time - 1e-9 * scene_.step;
    while (now_.state.time < almost && report.verdict == "ok") {
      const double soon = now_.state.time + (1 - 1e-9) * scene_.step;
      for (std::size_t i = 0; i < cuts_.size() && cuts_[i].time < soon && report.verdict == "ok"; ++i) {
        if (made_.empty()) leave_out_far_parts();
        if (i == made_.size()) begin(i, method, options);
        if (cuts_[i].blade) advance_blade(i, method, options);
        if (made_[i].verdict != "ok") report.verdict = made_[i].verdict, report.reason = made_[i].reason;
      }
      if (report.verdict == "ok") report = step();
      if (report.verdict == "ok" && static_cast<double>(std::clock()) >= stop_at_) {
        char text[64];
        std::snprintf(text, sizeof text, "the limit is %g s", time_limit_);
        report.verdict = "timed_out", report.reason = text;
      }
    }
    if (report.verdict != "ok") verdict_ = {report.verdict, report.reason, now_.state.time};
    return report;
  }

  MotionCut try_cut(const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                    const CutOptions& options) override {
    trial_ = now_;  // into the room that is there
    const StepReport last = stepper_.step(trial_.model, trial_.state);
    const State at_last = trial_.state;
    MotionCut result = cut(trial_, cuts, cutter, method, options);
    if (result.verdict != "ok") return result;
    const State at_cut = trial_.state;
    result.first_step = stepper_.step(trial_.model, trial_.state);
    for (const StepReport& step : {last, result.first_step})
      if (step.verdict != "ok") result.verdict = step.verdict, result.reason = step.reason;
    result.triplets_us = time_triplets(trial_.model);
    StopWatch watch;
    Physics without_bending = scene_.physics;
    without_bending.bending = BendingKind::none;
    const Model<D> anew(trial_.sheet, scene_.material, without_bending, trial_.pins, scene_.tractions);
    result.rebuild_us = watch.lap();
    if (scene_.physics.bending != BendingKind::none) {
      const Bending bending(trial_.sheet, scene_.physics.bending, scene_.material.bending, scene_.material.poisson);
      result.bending_rebuild_us = watch.lap();
    }
    // The balances come last: looking at the model before would have warmed it up.
    result.before = balance_of(now_.model, at_last);
    result.after = balance_of(trial_.model, at_cut);
    return result;
  }

 private:
  /// Everything that a step or a cut changes.
  struct Now {
    explicit Now(const Scene& scene)
        : sheet(mesh_of(scene)),
          locator(sheet),
          pins(pins_of(scene, sheet)),
          model(sheet, scene.material, scene.physics, pins, scene.tractions),
          state(initial_state(model, sheet)) {
      hold_tied_vertices(pins, scene.tractions, sheet);
    }
    Sheet sheet;
    Locator locator;
    std::vector<Pin> pins;
    Model<D> model;
    State state;
  };
  struct DueCut {
    double time, speed;
    std::vector<Curve> curves;
    PickedCurve picked;
    std::optional<Blade> blade;  ///< while it is on its way
    double reached;              ///< m: what it has cut
  };

  static StepOptions options_of(const Scene& scene) {
    return {scene.integrator, scene.step, scene.newton, scene.sweeps, scene.solver};
  }

  StepReport step() {
    if (budget_) before_ = now_.state;
    StepReport report = stepper_.step(now_.model, now_.state);
    if (budget_ && report.verdict == "ok") budget_->add_step(now_.model, before_, now_.state, scene_.step);
    if (watched_ && report.verdict == "ok") judge_state(report);
    next_.step = report;
    steps_.push_back(next_);
    next_ = {};
    return report;
  }

  /// \pre the step is in the budget, where one is kept.
  void judge_state(StepReport& report) {
    const Energy energy = budget_ ? budget_->rows().back().energy : balance().energy;
    if (!std::isfinite(energy.total()) || !std::isfinite(energy.kinetic)) {
      report.verdict = "not_finite", report.reason = "the energy";
      return;
    }
    if (verdict_.name != "ok") return;  // the first fault counts
    const TurnedOver turned = turned_over(now_.sheet, now_.model.elements(), now_.state.x, D);
    const bool inverted = D == 2 ? turned.triangles > 0 : turned.area > most_turned;
    char text[96];
    std::snprintf(text, sizeof text, "%zu triangles, %.2g %% of the rest area, are turned over", turned.triangles,
                  100 * turned.area);
    if (inverted) verdict_ = {"inverted", text, now_.state.time};
    if (const std::string fault = budget_ ? budget_->fault() : ""; verdict_.name == "ok" && !fault.empty())
      verdict_ = {"energy_growth", fault, now_.state.time};
  }

  void begin_budget() {
    const double noise = 1e-20 * scene_.material.stiffness / scene_.material.density * now_.model.lumped_mass().sum();
    if (watched_ && keeps_budget(scene_.integrator))
      budget_.emplace(balance(), scene_.integrator, noise, now_.state.time);
  }

  /// Before the first cut. The budget begins again with what is left.
  void leave_out_far_parts() {
    if (!std::isfinite(scene_.active_radius)) return;
    StopWatch watch;
    std::vector<Curve> curves;
    for (const DueCut& cut : cuts_) curves.insert(curves.end(), cut.curves.begin(), cut.curves.end());
    const ActiveRegion region = active_region(now_.sheet, curves, scene_.active_radius);
    if (region.pins.empty()) return;
    now_.sheet.begin_cut();
    now_.sheet.remove(region.outside);
    transfer(now_.sheet.log(), now_.sheet.deformed_slots(), D, now_.state);
    renumber(now_.sheet.compact().deformed, D, now_.state);
    now_.locator = Locator(now_.sheet);
    now_.pins.insert(now_.pins.end(), region.pins.begin(), region.pins.end());
    hold_tied_vertices(region.pins, {}, now_.sheet);
    now_.model = Model<D>(now_.sheet, scene_.material, scene_.physics, now_.pins, scene_.tractions);
    now_.model.reserve_spare();
    hold_where_it_is(now_.model, now_.state);
    before_cuts_ = now_.sheet;
    next_.update_us += watch.lap();
    begin_budget();
  }

  /// Makes a cut that is due, or lets its blade enter.
  void begin(std::size_t number, CuttingMethod& method, const CutOptions& options) {
    DueCut& due = cuts_[number];
    std::vector<Curve> curves = due.curves;
    double pick_us = 0;
    if (!due.picked.picks.empty()) {
      const Sheet posed = posed_sheet();
      StopWatch watch;
      curves.push_back(Picker(posed).rest_curve(due.picked, scene_.stem + ", cut " + std::to_string(number)));
      pick_us = watch.lap();
    }
    if (due.speed > 0) due.blade.emplace(curves.front());
    made_.push_back(due.blade ? MotionCut() : cut_with_balances(curves, method, options));
    made_.back().pick_us = pick_us;
    next_.geometry_us += pick_us;
  }

  /// Up to where the blade is at the end of this step, or where it waits. A part that can't be cut by itself goes with
  /// the next one, too.
  void advance_blade(std::size_t number, CuttingMethod& method, const CutOptions& options) {
    DueCut& due = cuts_[number];
    MotionCut& made = made_[number];
    const double h = now_.sheet.mean_edge(), end = due.blade->length();
    const double to = std::min(end, due.speed * std::max(0.0, now_.state.time + scene_.step - due.time));
    if (to <= due.reached) return;
    const Curve curve = due.blade->part(due.reached, to);
    if (to < end && to < due.reached + h && distance_to_edges(now_.sheet, curve.points.back()) < clear_of_edges * h)
      return;
    const MotionCut part = cut_with_balances({curve}, method, options);
    const bool cut = part.cut.status == Status::ok || part.cut.status == Status::deviated;
    if (cut) due.reached = to;
    if (cut || part.verdict != "ok") add(part, made);
    if (made.parts == 0) made.cut.status = part.cut.status, made.reason = part.reason;
    if (to == end && part.cut.status == Status::refused && made.parts > 0)
      made.cut.status = Status::deviated, made.reason = "its end was refused: " + part.reason;
    if (to == end) due.blade.reset();
  }

  static void add(const MotionCut& part, MotionCut& sum) {
    if (sum.parts++ == 0) {
      const double pick_us = sum.pick_us;
      sum = part, sum.pick_us = pick_us;
      return;
    }
    if (sum.cut.status != Status::deviated) sum.cut.status = part.cut.status;
    sum.cut.crossed_triangles += part.cut.crossed_triangles;
    sum.cut.time_us += part.cut.time_us, sum.cut.cpu_us += part.cut.cpu_us;
    sum.verdict = part.verdict, sum.reason = part.reason;
    sum.transfer_us += part.transfer_us, sum.pattern_us += part.pattern_us, sum.bending_us += part.bending_us;
    const Energy &was = part.before.energy, &is = part.after.energy;
    sum.after.energy.membrane += is.membrane - was.membrane, sum.after.energy.bending += is.bending - was.bending;
    sum.after.energy.kinetic += is.kinetic - was.kinetic, sum.after.energy.potential += is.potential - was.potential;
    sum.after.residual += part.after.residual - part.before.residual;
    sum.after.momentum = sum.after.momentum + part.after.momentum + -1 * part.before.momentum;
    sum.after.angular_momentum =
        sum.after.angular_momentum + part.after.angular_momentum + -1 * part.before.angular_momentum;
  }

  MotionCut cut_with_balances(const std::vector<Curve>& curves, CuttingMethod& method, const CutOptions& options) {
    const Balance before = balance();
    MotionCut made = cut(now_, curves, cutter_, method, options);
    made.before = before, made.after = balance();
    next_.has_cut = true;
    next_.geometry_us += made.cut.time_us.total(), next_.bending_us += made.bending_us;
    next_.update_us += made.transfer_us + made.pattern_us;
    if (budget_) budget_->add_cut(made.before, made.after);
    return made;
  }

  /// Cuts, and carries state and model over.
  MotionCut cut(Now& now, const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                const CutOptions& options) {
    MotionCut result;
    result.parts = 1;
    std::optional<std::string> refusal;  // of any of the curves
    if (const std::string reason = why_not(method.tying()); !reason.empty()) {
      result.cut.status = Status::refused, result.cut.reason = result.reason = reason;
      return result;
    }
    for (const Curve& curve : cuts) {
      const CutRun run = cut_all(now.sheet, now.locator, cutter, {&curve, 1}, method, options);
      result.cut.status = run.status, result.cut.verdict = run.verdict, result.cut.reason = run.reason;
      result.cut.crossed_triangles += run.crossed_triangles;
      result.cut.time_us += run.time_us, result.cut.cpu_us += run.cpu_us;
      result.verdict = run.verdict, result.reason = run.reason;
      if (run.status == Status::refused) refusal = run.reason;
      if (run.status == Status::noop || run.status == Status::refused) continue;
      if (run.verdict != "ok") return result;
      StopWatch watch;
      transfer(now.sheet.log(), now.sheet.deformed_slots(), D, now.state);
      result.transfer_us += watch.lap();
      now.model.update(now.sheet);
      result.pattern_us += watch.lap();
      now.model.update_bending(now.sheet);
      result.bending_us += watch.lap();
      if (method.tying() == CuttingMethod::Tying::nothing) continue;
      const Ties ties = method.next_ties(before_cuts_, now.sheet, now.model.polygons_left());
      result.cut.time_us.tie += watch.lap();
      now.model.tie(now.sheet, ties);
      for (Field* const field : {&now.state.x, &now.state.v}) {  // the state of before the cut need not
        if (now.model.tied()) now.model.tied()->satisfy(now.model.held(), *field);
        now.model.follow(*field);
      }
      result.pattern_us += watch.lap();
    }
    if (refusal) result.cut.status = Status::refused, result.reason = *refusal;
    return result;
  }

  /// A method can't be used in this scene for what it ties; empty: it can.
  std::string why_not(CuttingMethod::Tying tying) const {
    if (tying == CuttingMethod::Tying::nothing) return {};
    if (scene_.integrator == Integrator::xpbd)
      return "the method ties vertices or makes polygons, which xpbd does not take; choose another integrator";
    if (tying == CuttingMethod::Tying::polygons)
      return scene_.physics.bending == BendingKind::hinges
                 ? "the method's polygons have no hinges; set bending to patches, or to none"
                 : "";
    if (scene_.integrator == Integrator::symplectic_euler)
      return "the method ties vertices to others, which symplectic_euler does not take; choose an implicit integrator";
    if (tying == CuttingMethod::Tying::phantoms_at_rest)
      return "the method's ghost penalty or lumped mass is for sheets at rest; use phantom_node with ghost=0";
    if (tying == CuttingMethod::Tying::phantoms && scene_.physics.bending != BendingKind::none)
      return "the method's phantom nodes do not bend; set bending to none";
    return {};
  }

  Scene scene_;
  Now now_, trial_;
  Sheet before_cuts_;
  Stepper<D> stepper_;
  Cutter cutter_;
  std::vector<DueCut> cuts_;
  std::vector<MotionCut> made_;
  bool watched_ = false;
  std::optional<EnergyBudget> budget_;
  State before_;  // the step, for the budget
  SimulationVerdict verdict_;
  double time_limit_ = 0, stop_at_ = std::numeric_limits<double>::infinity();  // s; ticks of std::clock()
  std::vector<LoggedStep> steps_;
  LoggedStep next_;  // the cuts made since the last step
};

}  // namespace

std::unique_ptr<Simulation> Simulation::start(const Scene& scene) {
  if (scene.physics.dimension == 2) return std::make_unique<SceneInMotion<2>>(scene);
  return std::make_unique<SceneInMotion<3>>(scene);
}

}  // namespace cutbench
