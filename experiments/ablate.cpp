#include "experiments/ablate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <optional>

#include "harness/base/errors.h"
#include "harness/mesh/families.h"
#include "harness/scene/simulation.h"

namespace cutbench {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double patience = 10, least_patience = 5;  // of a run: times the whole model's processor time, and s
constexpr double safety = 0.9;                       // of an explicit step: the limit is that of the sheet at rest

double distance(Point3 a, Point3 b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

bool in_use(const Sheet& sheet, std::size_t d) { return sheet.rest_vertex(DeformedIndex(d)).valid(); }

double largest_deflection(const Sheet& end) {
  double largest = 0;
  for (std::size_t d = 0; d < end.deformed_slots(); ++d)
    if (in_use(end, d)) {
      const Point2 rest = end.rest(end.rest_vertex(DeformedIndex(d)));
      largest = std::max(largest, distance(end.position(DeformedIndex(d)), {rest.x, rest.y, 0}));
    }
  return largest;
}

double largest_gape(const Sheet& end) {
  std::vector<std::vector<Point3>> copies(end.vertex_slots());
  double largest = 0;
  for (std::size_t d = 0; d < end.deformed_slots(); ++d)
    if (in_use(end, d)) {
      auto& others = copies[end.rest_vertex(DeformedIndex(d))()];
      const Point3 here = end.position(DeformedIndex(d));
      for (const Point3 other : others) largest = std::max(largest, distance(here, other));
      others.push_back(here);
    }
  return largest;
}

/// NaN where they are not the same sheet, cut alike.
double largest_deviation(const Sheet& a, const Sheet& b) {
  if (a.deformed_slots() != b.deformed_slots()) return none;
  double largest = 0;
  for (std::size_t d = 0; d < a.deformed_slots(); ++d) {
    const DeformedIndex i(d);
    if (in_use(a, d) != in_use(b, d)) return none;
    if (!in_use(a, d)) continue;
    if (!(a.rest(a.rest_vertex(i)) == b.rest(b.rest_vertex(i)))) return none;
    largest = std::max(largest, distance(a.position(i), b.position(i)));
  }
  return largest;
}

double steps_of(const Scene& scene) { return std::ceil(scene.duration / scene.step - 1e-9); }
double end_of(const Scene& scene) {
  return scene.integrator == Integrator::equilibrium ? scene.step : steps_of(scene) * scene.step;
}

/// Ends at the same time, in so many steps or one more.
void set_steps(Scene& scene, double steps) {
  scene.duration = end_of(scene), scene.step = scene.duration / std::ceil(steps);
}

struct Run {
  Ablation row;
  std::optional<Sheet> end;
  double explicit_limit = none;  // s
  double processor_s = 0;
};

Run run(const AblatedScene& ablated, CuttingMethod& method, const CutOptions& options, double time_limit) {
  const Scene& scene = ablated.scene;
  Run result;
  result.row.without = ablated.without;
  try {
    const auto motion = Simulation::start(scene);
    const std::clock_t start = std::clock();
    motion->watch();
    motion->limit_time(time_limit);
    const bool at_rest = scene.integrator == Integrator::equilibrium;
    motion->advance(end_of(scene), method, options);
    result.processor_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    result.end = motion->posed_sheet();
    result.row.verdict = motion->verdict().name, result.row.reason = motion->verdict().reason;
    for (const MotionCut& cut : motion->made_cuts())
      if (cut.cut.status != Status::ok && cut.cut.status != Status::noop && result.row.verdict == "ok")
        result.row.verdict = name_of(cut.cut.status), result.row.reason = cut.reason;
    double us = 0;
    for (const LoggedStep& step : motion->steps()) us += step.total_us();
    result.row.steps = static_cast<int>(motion->steps().size());
    result.row.ms_per_second = us / 1000 / (at_rest ? 1 : motion->time());
    const std::string& verdict = motion->verdict().name;
    if (verdict != "ok" && verdict != "inverted" && verdict != "energy_growth") result.end.reset();  // it ended early
    if (result.end)
      result.row.deflection = largest_deflection(*result.end), result.row.gape = largest_gape(*result.end);
    if (ablated.without.empty() && !at_rest) result.explicit_limit = motion->step_limits().with_bending;
  } catch (const InputError& error) {
    result.row.verdict = "refused", result.row.reason = error.what();
  }
  return result;
}

AblatedScene explicit_scene(Scene scene, double limit) {
  set_steps(scene, std::max(steps_of(scene), end_of(scene) / (safety * limit)));
  scene.integrator = Integrator::symplectic_euler;
  return {"implicit steps", std::move(scene)};
}

double percent(double value, double whole) { return 100 * (value - whole) / whole; }

}  // namespace

std::vector<AblatedScene> ablations_of(const Scene& scene) {
  std::vector<AblatedScene> all{{"", scene}};
  const auto add = [&](const std::string& without, auto change) {
    Scene less = scene;
    change(less);
    all.push_back({without, std::move(less)});
  };
  if (scene.physics.bending != BendingKind::none)
    add("bending", [](Scene& s) { s.physics.bending = BendingKind::none; });
  if (scene.physics.stress_stiffness_made() != StressStiffness::none)
    add("stiffness from stress", [](Scene& s) { s.physics.stress_stiffness = StressStiffness::none; });
  if (scene.newton > 1 && scene.integrator != Integrator::equilibrium)
    add("further Newton iterations", [](Scene& s) { s.newton = 1; });
  if (scene.physics.strain == Strain::green)
    add("nonlinear strain", [](Scene& s) { s.physics.strain = Strain::corotational; });
  if (scene.physics.strain == Strain::green || scene.physics.strain == Strain::corotational)
    add("rotation of elements", [](Scene& s) { s.physics.strain = Strain::linear; });
  if (scene.physics.strain != Strain::springs && !adds_mass(scene.physics.mass))
    add("triangles (springs)", [](Scene& s) { s.physics.strain = Strain::springs; });
  if (scene.physics.dimension == 3)
    add("the third dimension", [](Scene& s) { s.physics.dimension = 2, s.physics.bending = BendingKind::none; });
  if (scene.integrator != Integrator::equilibrium)
    add("every second step", [](Scene& s) { set_steps(s, steps_of(s) / 2); });
  if (const int side = scene.family.empty() ? 0 : squares_per_side(scene.resolution) / 2; side > 0)
    add("three of four triangles", [&](Scene& s) { s.resolution = 2 * side * side; });
  return all;
}

std::vector<Ablation> ablate(const Scene& scene, CuttingMethod& method, const CutOptions& options, double time_limit) {
  std::vector<Ablation> rows;
  std::optional<Sheet> whole;
  double limit = none, time = time_limit;
  const auto add = [&](const AblatedScene& ablated) {
    Run made = run(ablated, method, options, time);
    if (rows.empty()) {
      whole = made.end, limit = made.explicit_limit;
      time = std::min(time_limit, std::max(least_patience, patience * made.processor_s));
    }
    made.row.deviation = whole && made.end ? largest_deviation(*whole, *made.end) : none;
    rows.push_back(std::move(made.row));
  };
  for (const AblatedScene& ablated : ablations_of(scene)) add(ablated);
  if (limit > 0 && scene.integrator != Integrator::symplectic_euler) add(explicit_scene(scene, limit));
  return rows;
}

void print_ablations(const std::vector<Ablation>& rows) {
  const Ablation& whole = rows.front();
  std::printf("%-26s %-14s %12s %9s %9s %11s %9s %12s %9s\n", "without", "verdict", "moved m", "change %", "gape m",
              "change %", "dev. %", "ms/s", "saved %");
  for (const Ablation& row : rows) {
    const std::string name = row.without.empty() ? "(whole model)" : row.without;
    std::printf("%-26s %-14s", name.c_str(), row.verdict.c_str());
    if (row.verdict == "refused") {
      std::printf(" %s\n", row.reason.c_str());
      continue;
    }
    const auto number = [](int width, double value) {
      if (std::isfinite(value))
        std::printf(" %*.3g", width, value);
      else
        std::printf(" %*s", width, "-");
    };
    number(12, row.deflection), number(9, percent(row.deflection, whole.deflection));
    number(9, row.gape), number(11, percent(row.gape, whole.gape));
    number(9, 100 * row.deviation / whole.deflection), number(12, row.ms_per_second);
    number(9, 100 * (1 - row.ms_per_second / whole.ms_per_second));
    std::printf("\n");
  }
}

nlohmann::ordered_json json_of(const std::vector<Ablation>& rows) {
  auto array = nlohmann::ordered_json::array();
  const auto number = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr; };
  for (const Ablation& row : rows)
    array.push_back({{"without", row.without},
                     {"verdict", row.verdict},
                     {"reason", row.reason},
                     {"deflection_m", number(row.deflection)},
                     {"gape_m", number(row.gape)},
                     {"deviation_m", number(row.deviation)},
                     {"ms_per_s", number(row.ms_per_second)},
                     {"steps", row.steps}});
  return array;
}

}  // namespace cutbench
