#include "harness/simulation/scene_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/cut/motion.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/model/settle.h"
#include "harness/mesh/one_ring.h"
#include "harness/simulation/active_region.h"

namespace cutbench {

namespace {

/// A blade's tip on its way leaves no slivers: it waits while it is nearer to an edge than this (but not on it), for as
/// long as one h at most; in mean rest edges h.
constexpr double clear_of_edges = 0.05;

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

std::span<const double> span_of(const Field& field) { return {field.data(), to_size(field.size())}; }

/// cut_all() by a method that sees how the sheet moves.
CutRun cut_in_motion(Sheet& sheet, Locator& locator, Cutter& cutter, const Curve& curve, CuttingMethod& method,
                     const CutOptions& options, const Motion& motion) {
  struct Eyes {
    CuttingMethod& method;
    ~Eyes() { method.see(nullptr); }
  } const eyes{method};
  method.see(&motion);
  return cut_all(sheet, locator, cutter, {&curve, 1}, method, options);
}

void add(const MotionCut& part, MotionCut& sum) {
  if (sum.parts++ == 0) {
    const double pick_us = sum.pick_us;
    sum = part;
    sum.pick_us = pick_us;
    return;
  }
  if (sum.cut.status != Status::deviated) sum.cut.status = part.cut.status;
  sum.cut.crossed_triangles += part.cut.crossed_triangles;
  sum.cut.time_us += part.cut.time_us;
  sum.cut.cpu_us += part.cut.cpu_us;
  sum.verdict = part.verdict;
  sum.reason = part.reason;
  sum.transfer_us += part.transfer_us;
  sum.pattern_us += part.pattern_us;
  sum.bending_us += part.bending_us;
  const Energy &was = part.before.energy, &is = part.after.energy;
  sum.after.energy.membrane += is.membrane - was.membrane;
  sum.after.energy.bending += is.bending - was.bending;
  sum.after.energy.kinetic += is.kinetic - was.kinetic;
  sum.after.energy.potential += is.potential - was.potential;
  sum.after.residual += part.after.residual - part.before.residual;
  sum.after.momentum = sum.after.momentum + part.after.momentum + -1 * part.before.momentum;
  sum.after.angular_momentum =
      sum.after.angular_momentum + part.after.angular_momentum + -1 * part.before.angular_momentum;
}

}  // namespace

template <int D>
SceneCuts<D>::SceneCuts(const Scene& scene, MovingSheet<D>& now) : scene_(scene), now_(now), before_cuts_(now.sheet) {
  check_radius_spans_edges(now.sheet, scene.active_radius, scene.stem);
  for (const auto& cut : scene.cuts)
    cuts_.push_back({.time = cut.time, .speed = cut.speed, .curves = curves_of(cut, now.sheet), .picked = cut.picked});
}

/// Before the step that is next.
template <int D>
bool SceneCuts<D>::is_due(const DueCut& cut) const {
  return cut.time < now_.state.time + (1 - 1e-9) * scene_.step;
}

template <int D>
const MotionCut* SceneCuts<D>::make_due(CuttingMethod& method, const CutOptions& options, EnergyBudget* budget) {
  for (DueCut& due : cuts_) {
    if (!is_due(due)) break;
    if (!due.made) begin(due, method, options, budget);
    if (due.blade) advance_blade(due, method, options, budget);
    if (made_[*due.made].verdict != Verdict::ok) return &made_[*due.made];
  }
  return nullptr;
}

template <int D>
const MotionCut& SceneCuts<D>::make_now(std::span<const Curve> curves, CuttingMethod& method, const CutOptions& options,
                                        EnergyBudget* budget) {
  const std::string where = scene_.stem + ", a cut at " + std::to_string(now_.state.time) + " s";
  if (curves.empty()) throw InputError(where + ": no curve; give at least one");
  if (std::isfinite(scene_.active_radius))
    throw InputError(where + ": an active radius needs to know all cuts from the start; leave it out");
  for (const Curve& curve : curves) check_curve(curve, where);
  made_.push_back(cut_with_balances(curves, method, options, budget));
  return made_.back();
}

template <int D>
LoggedStep SceneCuts<D>::take_log() {
  return std::exchange(log_, {});
}

template <int D>
bool SceneCuts<D>::leave_out_far_parts() {
  if (!made_.empty() || cuts_.empty() || !is_due(cuts_.front())) return false;
  if (!std::isfinite(scene_.active_radius)) return false;
  StopWatch watch;
  std::vector<Curve> curves;
  for (const DueCut& cut : cuts_) curves.insert(curves.end(), cut.curves.begin(), cut.curves.end());
  const ActiveRegion region = active_region(now_.sheet, curves, scene_.active_radius);
  if (region.pins.empty()) return false;
  now_.sheet.begin_cut();
  now_.sheet.remove(region.outside);
  transfer(now_.sheet.log(), now_.sheet.deformed_slots(), D, now_.state);
  renumber(now_.sheet.compact().deformed, D, now_.state);
  now_.locator = Locator(now_.sheet);
  now_.pins.insert(now_.pins.end(), region.pins.begin(), region.pins.end());
  hold_constrained_vertices(region.pins, {}, now_.sheet);
  now_.model = Model<D>(now_.sheet, scene_.material, scene_.physics, now_.pins, scene_.tractions);
  now_.model.reserve_spare();
  hold_where_it_is(now_.model, now_.state);
  before_cuts_ = now_.sheet;
  log_.update_us += watch.lap();
  return true;
}

/// Makes a cut that is due, or lets its blade enter.
template <int D>
void SceneCuts<D>::begin(DueCut& due, CuttingMethod& method, const CutOptions& options, EnergyBudget* budget) {
  std::vector<Curve> curves = due.curves;
  double pick_us = 0;
  if (!due.picked.picks.empty()) {
    const Sheet posed = now_.posed();
    StopWatch watch;
    const auto number = to_size(&due - cuts_.data());
    curves = Picker(posed).rest_curves(due.picked, scene_.stem + ", cut " + std::to_string(number));
    pick_us = watch.lap();
  }
  if (due.speed > 0 && curves.size() > 1)
    throw InputError(scene_.stem + ", cut " + std::to_string(&due - cuts_.data()) +
                     ": a blade can't advance over a seam; leave its speed out, or cut each panel by itself");
  if (due.speed > 0) due.blade.emplace(curves.front());
  due.made = made_.size();
  made_.push_back(due.blade ? MotionCut() : cut_with_balances(curves, method, options, budget));
  made_.back().pick_us = pick_us;
  log_.geometry_us += pick_us;
}

/// Up to where the blade is at the end of this step, or where it waits. A part that can't be cut by itself goes with
/// the next one, too.
template <int D>
void SceneCuts<D>::advance_blade(DueCut& due, CuttingMethod& method, const CutOptions& options, EnergyBudget* budget) {
  MotionCut& made = made_[*due.made];
  const double h = now_.sheet.mean_edge(), end = due.blade->length();
  const double to = std::min(end, due.speed * std::max(0.0, now_.state.time + scene_.step - due.time));
  if (to <= due.reached) return;
  const Curve curve = due.blade->part(due.reached, to);
  if (to < end && to < due.reached + h && distance_to_edges(now_.sheet, curve.points.back()) < clear_of_edges * h)
    return;
  const MotionCut part = cut_with_balances({&curve, 1}, method, options, budget);
  const bool cut = part.cut.status == Status::ok || part.cut.status == Status::deviated;
  if (cut) due.reached = to;
  if (cut || part.verdict != Verdict::ok) add(part, made);
  if (made.parts == 0) {
    made.cut.status = part.cut.status;
    made.reason = part.reason;
  }
  if (to == end && part.cut.status == Status::refused && made.parts > 0) {
    made.cut.status = Status::deviated;
    made.reason = "its end was refused: " + part.reason;
  }
  if (to == end) due.blade.reset();
}

template <int D>
MotionCut SceneCuts<D>::cut_with_balances(std::span<const Curve> curves, CuttingMethod& method,
                                          const CutOptions& options, EnergyBudget* budget) {
  const Balance before = now_.balance();
  const double mass = now_.model.lumped_mass().sum();
  MotionCut made = cut(now_, curves, cutter_, method, options);
  made.before = before;
  made.after = now_.balance();
  log_.has_cut = true;
  log_.geometry_us += made.cut.time_us.total();
  log_.bending_us += made.bending_us;
  log_.update_us += made.transfer_us + made.pattern_us;
  const bool keeps_mass = std::abs(now_.model.lumped_mass().sum() - mass) <= 1e-9 * mass;
  if (budget) budget->add_cut(made.before, made.after, keeps_mass);
  return made;
}

template <int D>
MotionCut SceneCuts<D>::cut(MovingSheet<D>& moving, std::span<const Curve> curves, Cutter& cutter,
                            CuttingMethod& method, const CutOptions& options) const {
  MotionCut result;
  result.parts = 1;
  std::optional<std::string> refusal;  // of any of the curves
  const ConstraintSource* const source = method.constraint_source();
  if (const std::string reason = why_not(source); !reason.empty()) {
    result.cut.status = Status::refused;
    result.cut.reason = result.reason = reason;
    return result;
  }
  for (const Curve& curve : curves) {
    const std::size_t vertices_before = moving.sheet.deformed_slots();
    const Motion motion{
        .x = span_of(moving.state.x), .v = span_of(moving.state.v), .dimension = D, .poisson = scene_.material.poisson};
    const CutRun run = cut_in_motion(moving.sheet, moving.locator, cutter, curve, method, options, motion);
    result.cut.status = run.status;
    result.cut.verdict = run.verdict;
    result.cut.reason = run.reason;
    result.cut.crossed_triangles += run.crossed_triangles;
    result.cut.time_us += run.time_us;
    result.cut.cpu_us += run.cpu_us;
    result.verdict = run.verdict;
    result.reason = run.reason;
    if (run.status == Status::refused) refusal = run.reason;
    if (run.status == Status::noop || run.status == Status::refused) continue;
    if (run.verdict != Verdict::ok) return result;
    StopWatch watch;
    const State phantoms = take_phantoms(moving.model.first_phantom(), D, moving.state);
    const bool merges = source && source->constraint_kind() == ConstraintKind::polygons;
    const bool settles = D == 3 && scene_.robust && (!source || merges) && moving.sheet.seams().empty();
    const bool looks = settles && !merges;  // whether there is something to settle
    const Field places_before = looks ? moving.state.x : Field();
    transfer(moving.sheet.log(), moving.sheet.deformed_slots(), D, moving.state);
    result.transfer_us += watch.lap();
    moving.model.update(moving.sheet);
    result.pattern_us += watch.lap();
    const PlacesAtCut places{places_before, moving.state.x};
    const double bent = moving.model.update_bending(moving.sheet, looks ? &places : nullptr);
    result.bending_us += watch.lap();
    if (!source && moving.sheet.seams().empty()) {
      if (bent > 0) settle_new_vertices(moving.model, moving.sheet, moving.state.x);
      result.transfer_us += watch.lap();
      continue;
    }
    Constraints constraints;
    if (source)
      constraints = source->next_constraints(before_cuts_, moving.sheet, moving.constraints,
                                             moving.model.elements().left_since_change());
    result.cut.time_us.constrain += watch.lap();
    moving.model.constrain(moving.sheet, constraints);
    begin_phantoms(moving.sheet, moving.constraints, constraints, vertices_before, phantoms, moving.model,
                   moving.state);
    moving.constraints = std::move(constraints);
    result.pattern_us += watch.lap();
    if (settles) settle_new_vertices(moving.model, moving.sheet, moving.state.x);
    moving.keep_together();  // the state of before the cut need not
    result.transfer_us += watch.lap();
  }
  if (refusal) {
    result.cut.status = Status::refused;
    result.reason = *refusal;
  }
  return result;
}

/// A method can't be used in this scene for what it constrains; empty: it can.
template <int D>
std::string SceneCuts<D>::why_not(const ConstraintSource* source) const {
  if (!source) return {};
  const ConstraintKind constraint_kind = source->constraint_kind();
  if (sweeps(scene_.integrator))
    return std::string("the method constrains vertices or makes polygons, which ") +
           name_of(integrator_names, scene_.integrator) + " does not take; choose another integrator";
  if (constraint_kind == ConstraintKind::polygons)
    return scene_.physics.bending != BendingKind::none && !row_of(scene_.physics.bending).has_slopes
               ? "the method's polygons have no hinges; set bending to patches, or to none"
               : "";
  if (constraint_kind != ConstraintKind::vertices && before_cuts_.unrolled() &&
      scene_.physics.bending != BendingKind::none)
    return "the method's copied elements have no hinges that are curved at rest; set bending to none";
  const bool is_lumped = constraint_kind == ConstraintKind::lumped_phantoms;
  const bool adds = adds_mass(scene_.physics.mass);
  if (scene_.integrator == Integrator::symplectic_euler && is_lumped && adds)
    return "the method's elements take no added mass in explicit steps; set mass to lumped";
  if (scene_.integrator == Integrator::symplectic_euler && !is_lumped)
    return "the method constrains vertices to others, which symplectic_euler does not take; choose an implicit "
           "integrator";
  if (constraint_kind == ConstraintKind::phantoms_at_rest)
    return "the method's ghost penalty is for sheets at rest; set ghost=0";
  if ((is_lumped || constraint_kind == ConstraintKind::phantoms) && scene_.physics.bending != BendingKind::none && adds)
    return "the method's copied elements take no added mass for bending; set mass to lumped";
  return {};
}

template class SceneCuts<2>;
template class SceneCuts<3>;

}  // namespace cutbench
