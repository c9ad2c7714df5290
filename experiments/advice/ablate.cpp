#include "experiments/advice/ablate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/advice/scene_run.h"
#include "experiments/advice/sheet_levels.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "harness/mesh/locator.h"

namespace cutbench {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double patience = 10, least_patience = 5;  // of a run: times the whole model's processor time, and s
constexpr double small_steps = 10;                   // of xpbd, one sweep each, for one step
constexpr double active_share = 0.2;                 // active radius over the longer side of the sheet

/// Per slot of a sheet's vertex: it counts in no distance.
using LeftOut = std::vector<bool>;

/// NaN where they are not the same sheet, cut alike.
double largest_deviation(const Sheet& a, const Sheet& b, const LeftOut& left_out) {
  if (a.deformed_slots() != b.deformed_slots()) return none;
  double largest = 0;
  for (std::size_t d = 0; d < a.deformed_slots(); ++d) {
    const DeformedIndex i(d);
    if (in_use(a, d) != in_use(b, d)) return none;
    if (!in_use(a, d) || left_out[d]) continue;
    if (!(a.rest(a.rest_vertex(i)) == b.rest(b.rest_vertex(i)))) return none;
    largest = std::max(largest, distance(a.position(i), b.position(i)));
  }
  return largest;
}

using Places = std::map<std::pair<double, double>, std::vector<Point3>>;

/// By rest position: where its vertices are, those of both lips.
Places places_of(const Sheet& sheet, const LeftOut& left_out) {
  Places places;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    if (!in_use(sheet, d) || left_out[d]) continue;
    const Point2 rest = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
    places[{rest.x, rest.y}].push_back(sheet.position(DeformedIndex(d)));
  }
  return places;
}

double largest_distance_to_nearest(const std::vector<Point3>& from, const std::vector<Point3>& to) {
  double largest = 0;
  for (const Point3 p : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point3 q : to) nearest = std::min(nearest, distance(p, q));
    largest = std::max(largest, nearest);
  }
  return largest;
}

/// Of what is left of a sheet in the end, against the whole one cut alike: the Hausdorff distance of the vertices that
/// have a rest position in common. NaN where the part has one that the whole has not.
double largest_deviation_of_part(const Sheet& whole, const Sheet& part, const LeftOut& of_whole,
                                 const LeftOut& of_part) {
  const Places all = places_of(whole, of_whole);
  double largest = 0;
  for (const auto& [rest, here] : places_of(part, of_part)) {
    const auto there = all.find(rest);
    if (there == all.end()) return none;
    largest = std::max(
        {largest, largest_distance_to_nearest(here, there->second), largest_distance_to_nearest(there->second, here)});
  }
  return largest;
}

/// In rest space, m.
double longer_side(const Scene& scene) {
  const SheetExtent extent = extent_of(Sheet(mesh_of(scene)));
  return std::max(extent.high.x - extent.low.x, extent.high.y - extent.low.y);
}

/// The cuts are known from the start, in rest space.
bool knows_cuts(const Scene& scene) {
  return !scene.cuts.empty() &&
         std::ranges::all_of(scene.cuts, [](const Scene::Cut& cut) { return cut.picked.picks.empty(); });
}

Ablation row_of(const std::string& without, const SceneRun& run) {
  return {.without = without,
          .verdict = run.verdict,
          .reason = run.reason,
          .deflection = run.deflection,
          .gape = run.gape,
          .ms_per_second = run.ms_per_second,
          .steps = run.steps,
          .free_pieces = run.free_pieces,
          .fall = run.fall};
}

AblatedScene explicit_scene(Scene scene, double limit) {
  set_steps(scene, std::max(steps_of(scene), end_of(scene) / (explicit_safety * limit)));
  scene.integrator = Integrator::symplectic_euler;
  return {"implicit steps", std::move(scene)};
}

AblatedScene position_based_scene(Scene scene) {
  set_steps(scene, small_steps * steps_of(scene));
  scene.integrator = Integrator::xpbd;
  return {"linear solves (xpbd)", std::move(scene)};
}

/// Of what is left of the sheet round its cuts: no pin holds it there, so its pieces are found in the whole sheet.
LeftOut falls_of_part(const Sheet& whole, const LeftOut& falls, const Sheet& part) {
  const Locator locator(whole);
  LeftOut result(part.deformed_slots(), false);
  for (std::size_t t = 0; t < part.triangle_slots(); ++t) {
    const TriangleIndex triangle(t);
    if (!part.triangle(triangle).alive()) continue;
    const auto c = part.corners(triangle);
    const Point2 inside = 1.0 / 3 * (c[0] + c[1] + c[2]);
    const TriangleIndex there = triangle_at(whole, locator.near(whole, inside), inside);
    if (!falls[whole.triangle(there).deformed[0]()]) continue;
    for (const DeformedIndex d : part.triangle(triangle).deformed) result[d()] = true;
  }
  return result;
}

/// None where the sheet has a single triangle on a side.
std::optional<AblatedScene> coarser_scene(const Scene& scene) {
  const std::string without = "three of four triangles";
  if (!scene.mesh) {
    const int side = squares_per_side(scene.resolution) / 2;
    if (side == 0) return {};
    AblatedScene coarser{without, scene};
    coarser.scene.resolution = 2 * side * side;
    return coarser;
  }
  SheetLevels levels(scene);
  const auto triangles = levels.triangles(0.5);
  AblatedScene coarser{without, scene};
  if (triangles)
    levels.apply(coarser.scene, *triangles);
  else
    coarser.refused = levels.missing();
  return coarser;
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
  if (solves(scene.integrator) && scene.physics.stress_stiffness_made() != StressStiffness::none)
    add("stiffness from stress", [](Scene& s) { s.physics.stress_stiffness = StressStiffness::none; });
  if (scene.newton > 1 && !at_rest(scene)) add("further Newton iterations", [](Scene& s) { s.newton = 1; });
  if (scene.physics.strain == Strain::green)
    add("nonlinear strain", [](Scene& s) { s.physics.strain = Strain::corotational; });
  if (scene.physics.strain == Strain::green || scene.physics.strain == Strain::corotational)
    add("rotation of elements", [](Scene& s) { s.physics.strain = Strain::linear; });
  if (scene.physics.strain != Strain::springs && !adds_mass(scene.physics.mass))
    add("triangles (springs)", [](Scene& s) { s.physics.strain = Strain::springs; });
  if (scene.physics.dimension == 3)
    add("the third dimension", [](Scene& s) {
      s.physics.dimension = 2;
      s.physics.bending = BendingKind::none;
    });
  const bool in_motion = !at_rest(scene);
  if (in_motion && knows_cuts(scene) && std::isinf(scene.active_radius))
    add("motion far from the cuts", [](Scene& s) { s.active_radius = active_share * longer_side(s); });
  if (in_motion && !sweeps(scene.integrator) && scene.physics.mass == Mass::lumped)
    all.push_back(position_based_scene(scene));
  if (in_motion) add("every second step", [](Scene& s) { set_steps(s, steps_of(s) / 2); });
  if (const auto coarser = coarser_scene(scene)) all.push_back(*coarser);
  return all;
}

std::vector<Ablation> ablate(const Scene& scene, CuttingMethod& method, const CutOptions& options, double time_limit) {
  std::vector<Ablation> rows;
  std::optional<Sheet> whole;
  LeftOut falls;
  double limit = none, time = time_limit;
  const auto add = [&](const AblatedScene& ablated) {
    if (!ablated.refused.empty()) {
      rows.push_back({.without = ablated.without, .verdict = Verdict::refused, .reason = ablated.refused});
      return;
    }
    SceneRun made = run_to_end(ablated.scene, method, options, time);
    if (rows.empty()) {
      if (made.motion && !at_rest(scene)) limit = made.motion->step_limits().with_bending;
      if (made.ended()) {
        whole = made.motion->posed_sheet();
        falls = on_free_pieces(scene, *whole);
      }
      time = std::min(time_limit, std::max(least_patience, patience * made.processor_s));
    }
    const bool is_part = ablated.scene.active_radius < scene.active_radius;
    if (!whole || !made.ended()) {
      rows.push_back(row_of(ablated.without, made));
      return;
    }
    const Sheet end = made.motion->posed_sheet();
    const LeftOut falls_here = is_part ? falls_of_part(*whole, falls, end) : falls;
    if (is_part) measure(made, end, falls_here);
    rows.push_back(row_of(ablated.without, made));
    rows.back().deviation =
        is_part ? largest_deviation_of_part(*whole, end, falls, falls_here) : largest_deviation(*whole, end, falls);
  };
  for (const AblatedScene& ablated : ablations_of(scene)) add(ablated);
  if (limit > 0 && solves(scene.integrator)) add(explicit_scene(scene, limit));
  return rows;
}

void print_ablations(const std::vector<Ablation>& rows) {
  const Ablation& whole = rows.front();
  std::printf("%-26s %-14s %12s %9s %9s %11s %9s %12s %9s\n", "without", "verdict", "moved m", "change %", "gape m",
              "change %", "dev. %", "ms/s", "saved %");
  for (const Ablation& row : rows) {
    const std::string name = row.without.empty() ? "(whole model)" : row.without;
    std::printf("%-26s %-14s", name.c_str(), name_of(row.verdict));
    if (row.verdict == Verdict::refused) {
      std::printf(" %s\n", row.reason.c_str());
      continue;
    }
    const auto number = [](int width, double value) {
      if (std::isfinite(value))
        std::printf(" %*.3g", width, value);
      else
        std::printf(" %*s", width, "-");
    };
    number(12, row.deflection);
    number(9, percent(row.deflection, whole.deflection));
    number(9, row.gape);
    number(11, percent(row.gape, whole.gape));
    number(9, 100 * row.deviation / whole.deflection);
    number(12, row.ms_per_second);
    number(9, 100 * (1 - row.ms_per_second / whole.ms_per_second));
    std::printf("\n");
  }
  if (whole.free_pieces > 0)
    std::printf("left out of moved, gape and dev.: %d %s that nothing holds; at most %.3g m from rest\n",
                whole.free_pieces, whole.free_pieces == 1 ? "piece" : "pieces", whole.fall);
}

nlohmann::ordered_json json_of(const std::vector<Ablation>& rows) {
  auto array = nlohmann::ordered_json::array();
  const auto number = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr; };
  for (const Ablation& row : rows)
    array.push_back({{"without", row.without},
                     {"verdict", name_of(row.verdict)},
                     {"reason", row.reason},
                     {"deflection_m", number(row.deflection)},
                     {"gape_m", number(row.gape)},
                     {"deviation_m", number(row.deviation)},
                     {"ms_per_s", number(row.ms_per_second)},
                     {"steps", row.steps},
                     {"free_pieces", row.free_pieces},
                     {"fall_m", number(row.fall)}});
  return array;
}

}  // namespace cutbench
