#include "experiments/advice/scene_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <set>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/row_numbers.h"

namespace cutbench {

double distance(Point3 a, Point3 b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

bool in_use(const Sheet& sheet, std::size_t d) { return sheet.rest_vertex(DeformedIndex(d)).valid(); }

namespace {

/// Of vertices that are on free pieces, or of those that are not.
double largest_deflection(const Sheet& end, const std::vector<bool>& free, bool of_free) {
  double largest = 0;
  for (std::size_t d = 0; d < end.deformed_slots(); ++d)
    if (in_use(end, d) && free[d] == of_free) {
      const Point2 rest = end.rest(end.rest_vertex(DeformedIndex(d)));
      largest = std::max(largest, distance(end.position(DeformedIndex(d)), {rest.x, rest.y, 0}));
    }
  return largest;
}

double largest_gape(const Sheet& end, const std::vector<bool>& free) {
  std::vector<std::vector<Point3>> copies(end.vertex_slots());
  double largest = 0;
  for (std::size_t d = 0; d < end.deformed_slots(); ++d)
    if (in_use(end, d) && !free[d]) {
      auto& others = copies[end.rest_vertex(DeformedIndex(d))()];
      const Point3 here = end.position(DeformedIndex(d));
      for (const Point3 other : others) largest = std::max(largest, distance(here, other));
      others.push_back(here);
    }
  return largest;
}

/// Per slot of a deformed vertex, its piece; -1 where it is free.
std::vector<std::int32_t> pieces_by_vertex(const Sheet& sheet) {
  const MeshData mesh = sheet.to_mesh_data();
  const RowNumbers rows(sheet);
  const std::vector<std::int32_t> of_triangle = pieces_of(mesh);
  std::vector<std::int32_t> of_row(mesh.rest.size(), -1), result(sheet.deformed_slots(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::int32_t v : mesh.triangles[t]) of_row[to_size(v)] = of_triangle[t];
  for (std::size_t d = 0; d < result.size(); ++d)
    if (rows.vertex[d] >= 0) result[d] = of_row[to_size(rows.vertex[d])];
  return result;
}

int pieces_among(const Sheet& sheet, const std::vector<bool>& vertices) {
  const std::vector<std::int32_t> piece = pieces_by_vertex(sheet);
  std::set<std::int32_t> pieces;
  for (std::size_t d = 0; d < piece.size(); ++d)
    if (vertices[d]) pieces.insert(piece[d]);
  return to_int(pieces.size());
}

/// The word of a cut that is not ok.
Verdict verdict_of(Status status) { return value_named(verdict_names, name_of(status)).value(); }

double seconds_of(std::clock_t ticks) { return to_double(ticks) / CLOCKS_PER_SEC; }

}  // namespace

bool at_rest(const Scene& scene) { return scene.integrator == Integrator::equilibrium; }
bool is_explicit(const Scene& scene) { return scene.integrator == Integrator::symplectic_euler; }
double steps_of(const Scene& scene) { return at_rest(scene) ? 1 : std::ceil(scene.duration / scene.step - 1e-9); }
double end_of(const Scene& scene) { return steps_of(scene) * scene.step; }

std::vector<bool> on_free_pieces(const Scene& scene, const Sheet& end) {
  const std::vector<Pin> pins = pins_of(scene, Sheet(mesh_of(scene)));
  const std::vector<std::int32_t> piece = pieces_by_vertex(end);
  std::set<std::int32_t> held;
  for (std::size_t d = 0; d < piece.size(); ++d) {
    if (piece[d] < 0) continue;
    const Point2 rest = end.rest(end.rest_vertex(DeformedIndex(d)));
    if (std::any_of(pins.begin(), pins.end(), [&](const Pin& pin) { return pin.where.contains(rest); }))
      held.insert(piece[d]);
  }
  std::vector<bool> free(piece.size(), false);
  for (std::size_t d = 0; d < piece.size(); ++d) free[d] = !held.empty() && piece[d] >= 0 && !held.contains(piece[d]);
  return free;
}

void measure(SceneRun& run, const Sheet& end, const std::vector<bool>& free) {
  run.deflection = largest_deflection(end, free, false);
  run.gape = largest_gape(end, free);
  run.free_pieces = pieces_among(end, free);
  if (run.free_pieces > 0) run.fall = largest_deflection(end, free, true);
}

void set_steps(Scene& scene, double steps) {
  scene.duration = end_of(scene);
  scene.step = scene.duration / std::ceil(steps);
}

SceneRun run_to_end(const Scene& scene, CuttingMethod& method, const CutOptions& options, double time_limit) {
  SceneRun run;
  try {
    run.motion = Simulation::start(scene);
    const std::clock_t start = std::clock();
    run.motion->watch();
    run.motion->limit_time(time_limit);
    run.motion->advance(end_of(scene), method, options);
    run.processor_s = seconds_of(std::clock() - start);
    const Verdict verdict = run.motion->outcome().verdict;
    run.verdict = verdict;
    run.reason = run.motion->outcome().reason;
    for (const MotionCut& cut : run.motion->made_cuts())
      if (cut.cut.status != Status::ok && cut.cut.status != Status::noop && run.verdict == Verdict::ok) {
        run.verdict = verdict_of(cut.cut.status);
        run.reason = cut.reason;
      }
    double us = 0;
    for (const LoggedStep& step : run.motion->steps()) us += step.total_us();
    run.steps = to_int(run.motion->steps().size());
    run.ms_per_second = us / 1000 / (at_rest(scene) ? 1 : run.motion->time());
    if (verdict == Verdict::ok || verdict == Verdict::inverted ||
        verdict == Verdict::energy_growth) {  // others end it early
      const Sheet end = run.motion->posed_sheet();
      measure(run, end, on_free_pieces(scene, end));
    }
  } catch (const InputError& error) {
    run.verdict = Verdict::refused;
    run.reason = error.what();
  }
  return run;
}

double processor_ms_per_second(const Scene& scene, CuttingMethod& method, const CutOptions& options) {
  const auto motion = Simulation::start(scene);
  const std::clock_t start = std::clock();
  motion->advance(end_of(scene), method, options);
  return 1000 * seconds_of(std::clock() - start) / (at_rest(scene) ? 1 : motion->time());
}

}  // namespace cutbench
