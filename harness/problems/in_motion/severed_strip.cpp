#include "harness/problems/in_motion/severed_strip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_motion/add_step.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

namespace {

constexpr double strain = 0.1;
constexpr int left = 0, right = 1;

/// What is read off one bar: the part of the sheet at one of the clamps.
struct Bar {
  double length = 0;                                  ///< of the requested cut, m
  std::vector<DeformedIndex> clamp;                   ///< vertices
  std::vector<std::pair<DeformedIndex, double>> lip;  ///< weights of the mean along the lip: sum 1
  /// At the end of each step, from t = 0 on: stretch of the bar, m, as released_end() has it, and the clamp's force, N.
  std::vector<double> stretch, force;
};

/// For each deformed vertex one of its piece.
std::vector<std::size_t> pieces_of(const Sheet& sheet) {
  std::vector<std::size_t> parent(sheet.deformed_slots());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t d) {
    while (parent[d] != d) d = parent[d] = parent[parent[d]];
    return d;
  };
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (const Triangle& triangle = sheet.triangle(TriangleIndex(t)); triangle.alive())
      for (const DeformedIndex d : triangle.deformed) parent[root(d())] = root(triangle.deformed[0]());
  for (std::size_t d = 0; d < parent.size(); ++d) parent[d] = root(d);
  return parent;
}

/// Both bars, or none where the sheet is not severed. The mean along a lip is that over y, so that a lip with steps
/// counts as its projection on the straight one.
std::vector<Bar> bars_of(const Sheet& sheet, double cut) {
  const std::vector<std::size_t> piece = pieces_of(sheet);
  std::vector<Bar> bars(2);
  bars[left].length = cut;
  bars[right].length = 1 - cut;
  for (const DeformedIndex d : vertices_in_use(sheet)) {
    const double x = sheet.rest(sheet.rest_vertex(d)).x;
    if (x == 0) bars[left].clamp.push_back(d);
    if (x == 1) bars[right].clamp.push_back(d);
  }
  const std::size_t of_left = piece[bars[left].clamp.front()()], of_right = piece[bars[right].clamp.front()()];
  if (of_left == of_right) return {};

  std::map<std::pair<DeformedIndex, DeformedIndex>, double> rise;  // of the edges with a triangle on one side only
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    if (!triangle.alive()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const DeformedIndex a = triangle.deformed[k], b = triangle.deformed[(k + 1) % 3];
      const Point2 from = sheet.rest(triangle.vertex[k]), to = sheet.rest(triangle.vertex[(k + 1) % 3]);
      const bool at_clamp = from.x == to.x && (from.x == 0 || from.x == 1);
      if (rise.erase({b, a}) == 0 && !at_clamp) rise[{a, b}] = to.y - from.y;
    }
  }
  for (const auto& [edge, dy] : rise)
    for (const int side : {left, right})
      if (piece[edge.first()] == (side == left ? of_left : of_right))
        for (const DeformedIndex d : {edge.first, edge.second})
          bars[to_size(side)].lip.emplace_back(d, (side == left ? dy : -dy) / 2);
  return bars;
}

/// Of a series with a value every `step`, at a time within it.
double at(const std::vector<double>& series, double step, double time) {
  const auto k = std::min(to_size(time / step), series.size() - 2);
  const double part = time / step - to_double(k);
  return (1 - part) * series[k] + part * series[k + 1];
}

/// When the force at the clamp changes sign; the last time where it never does.
double arrival(const Bar& bar, double step) {
  std::size_t k = 1;
  while (k + 1 < bar.force.size() && bar.force[k] * bar.force[0] > 0) ++k;
  const double before = bar.force[k - 1], after = bar.force[k];
  return step * (to_double(k) - (before * after < 0 ? after / (after - before) : 0));
}

class SeveredStrip : public Problem {
 public:
  SeveredStrip(Integrator integrator, double step) : integrator_(integrator), step_(step) {}

  std::string name() const override {
    return std::string("severed_strip_").append(name_of(integrator_names, integrator_));
  }
  std::string effect() const override { return "the halves of a stretched strip cut across swing back"; }
  std::string truth() const override { return "a bar released at one end: a triangle wave (nu = 0; Graff, chapter 2)"; }
  std::vector<std::string> measures() const override { return {"lip_motion", "lip_speed", "arrival", "energy_kept"}; }
  bool takes_budgets() const override { return false; }
  bool takes_constraints() const override { return true; }
  bool in_motion() const override { return true; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    // In turns near a column of vertices of a grid, and anywhere between two.
    const double off = index % 2 == 0 ? distance_from_mesh_line(numbers) : numbers.between(0.1, 0.9);
    const double a = (std::round(n * numbers.between(0.4, 0.6)) + off) / n;
    result.origin = {a, 0};
    result.cuts = {{Curve::Kind::polyline, false, {{a, -0.1}, {a, 1.1}}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const double squares = std::sqrt(to_double(specimen.mesh.triangles.size()) / 2);
    std::vector<Answer> answers;
    for (const Budget& budget : budgets)
      swing(sheet, constraints, budget.solver, specimen.origin.x, step_ / squares, answers.emplace_back());
    return answers;
  }

 private:
  void swing(const Sheet& sheet, const Constraints& constraints, const SolverOptions& solver, double cut, double step,
             Answer& answer) const {
    std::vector<Bar> bars = bars_of(sheet, cut);
    if (bars.empty()) {
      answer.verdict = Verdict::not_severed;
      answer.reason = "the two clamps hold one piece";
      return;
    }
    constexpr double infinity = Box::infinity;
    Model<2> model(sheet, {.density = 1, .stiffness = 1, .poisson = 0}, {.dimension = 2, .strain = Strain::linear},
                   {{.where = {{-infinity, -infinity}, {0, infinity}}},
                    {.where = {{1, -infinity}, {infinity, infinity}}, .displacement = {strain, 0, 0}}},
                   {});
    if (!constraints.empty()) model.constrain(sheet, constraints);
    State state = initial_state(model, sheet);
    for (const DeformedIndex d : vertices_in_use(sheet)) {
      const Point2 p = sheet.rest(sheet.rest_vertex(d));
      state.x.segment<2>(2 * d.value) << (1 + strain) * p.x, p.y;
    }
    place_phantoms(model, state);
    for (const std::uint8_t held : model.held()) answer.unknowns += held == 0;

    Stepper<2> stepper({.integrator = integrator_, .step = step, .solver = solver});
    const double before = balance_of(model, state).energy.total();
    read(sheet, model, state, bars);
    const double end = 4 * std::max(cut, 1 - cut);
    while (state.time < end) {
      const StepReport report = stepper.step(model, state);
      add_step(report, answer);
      if (answer.verdict != Verdict::ok) return;
      read(sheet, model, state, bars);
    }
    answer.measures = measured(bars, step);
    answer.measures.push_back(compared("energy_kept", balance_of(model, state).energy.total() / before, 1));
  }

  static void read(const Sheet& sheet, Model<2>& model, const State& state, std::vector<Bar>& bars) {
    Field force = Field::Zero(state.x.size());
    model.rotate(state.x);
    model.add_internal_force(state.x, force);
    for (Bar& bar : bars) {
      const bool is_left = &bar == &bars.front();
      double stretch = is_left ? 0 : strain, pull = 0;
      for (const auto& [d, weight] : bar.lip)
        stretch += (is_left ? weight : -weight) * (state.x[2 * d.value] - sheet.rest(sheet.rest_vertex(d)).x);
      for (const DeformedIndex d : bar.clamp) pull += force[2 * d.value];
      bar.stretch.push_back(stretch);
      bar.force.push_back(pull);
    }
  }

  /// Means over both bars, each over its own period.
  static std::vector<Measure> measured(const std::vector<Bar>& bars, double step) {
    double squares = 0, speed = 0, time = 0, late = 0;
    for (const Bar& bar : bars) {
      double sum = 0;
      std::size_t steps = 0;
      for (double t = 0; steps < bar.stretch.size() && t <= 4 * bar.length; t = step * to_double(++steps))
        sum += std::pow(bar.stretch[steps] - released_end(strain, bar.length, t), 2);
      squares += sum / to_double(steps) / std::pow(strain * bar.length, 2) / 2;
      const double length = bar.length;
      speed += (at(bar.stretch, step, length / 2) - at(bar.stretch, step, 3 * length / 2)) / length / 2;
      time += arrival(bar, step) / 2;
      late += std::abs(arrival(bar, step) - length) / length / 2;
    }
    const double rms = std::sqrt(squares);
    return {{"lip_motion", rms, 0, rms}, compared("lip_speed", speed, strain), {"arrival", time, 0.5, late}};
  }

  Integrator integrator_;
  double step_;
};

}  // namespace

double released_end(double strain, double length, double time) {
  return strain * (std::abs(std::fmod(time, 4 * length) - 2 * length) - length);
}

std::unique_ptr<const Problem> severed_strip(Integrator integrator, double step) {
  return std::make_unique<SeveredStrip>(integrator, step);
}

}  // namespace cutbench
