#include "harness/simulation/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/cases/cut_families.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

Point2 nearest_vertex(const Sheet& sheet, Point2 to) {
  Point2 best;
  double distance2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sheet.vertex_slots(); ++i) {
    if (!sheet.triangle_of_vertex(VertexIndex(i)).valid()) continue;
    const Point2 p = sheet.rest(VertexIndex(i));
    if (const double d2 = squared_length(p - to); d2 < distance2) {
      best = p;
      distance2 = d2;
    }
  }
  return best;
}

bool between(const std::array<Point3, 2>& corners, Point3 p) {
  const auto& [low, high] = corners;
  return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
}

void add_pins_in_space(const ScenePin& scene_pin, const Sheet& sheet, std::vector<Pin>& pins) {
  for (std::size_t i = 0; i < sheet.deformed_slots(); ++i) {
    const DeformedIndex d(i);
    if (!sheet.rest_vertex(d).valid() || !between(*scene_pin.in_space, sheet.position(d))) continue;
    const Point2 at = sheet.rest(sheet.rest_vertex(d));
    pins.push_back(scene_pin.pin);
    pins.back().where = {at, at};
  }
}

void add_pins(const ScenePin& p, const Sheet& sheet, std::vector<Pin>& pins) {
  if (p.in_space) return add_pins_in_space(p, sheet, pins);
  pins.push_back(p.pin);
  if (!p.near) return;
  const Point2 at = nearest_vertex(sheet, *p.near);
  pins.back().where = {at, at};
}

}  // namespace

MeshData mesh_of(const Scene& scene) {
  if (scene.mesh) return *scene.mesh;
  MeshData mesh = make_sheet(scene.family, squares_per_side(scene.resolution));
  for (Point2& p : mesh.rest) p = scene.size * p;
  for (Point3& p : mesh.deformed) p = scene.size * p;
  return mesh;
}

std::vector<Pin> pins_of(const Scene& scene, const Sheet& sheet) {
  std::vector<Pin> pins;
  for (const ScenePin& p : scene.pins) add_pins(p, sheet, pins);
  return pins;
}

bool holds_a_vertex(const std::vector<Pin>& pins, const Sheet& sheet) {
  for (std::size_t i = 0; i < sheet.vertex_slots(); ++i) {
    const VertexIndex v(i);
    if (!sheet.triangle_of_vertex(v).valid()) continue;
    for (const Pin& pin : pins)
      if (pin.where.contains(sheet.rest(v))) return true;
  }
  return false;
}

std::vector<std::size_t> idle_pins(const Scene& scene, const Sheet& sheet) {
  std::vector<std::size_t> idle;
  for (std::size_t i = 0; i < scene.pins.size(); ++i) {
    std::vector<Pin> pins;
    add_pins(scene.pins[i], sheet, pins);
    if (!holds_a_vertex(pins, sheet)) idle.push_back(i);
  }
  return idle;
}

void check_scene_suits_seams(const Scene& scene, const Sheet& sheet) {
  const auto at_rest = [](const Scene::Cut& cut) { return cut.picked.picks.empty() && cut.family.empty(); };
  if (sheet.unrolled() && std::any_of(scene.cuts.begin(), scene.cuts.end(), at_rest))
    throw InputError(scene.stem +
                     ": the sheet is unrolled, so places at rest mean nothing; give its cuts with space = \"world\"");
  if (sheet.unrolled() && scene.physics.dimension == 2)
    throw InputError(scene.stem + ": the sheet is curved at rest, which takes dimension = 3");
  if (sheet.unrolled() && row_of(scene.physics.bending).has_slopes)
    throw InputError(scene.stem + ": the sheet is curved at rest, which " + name_of(scene.physics.bending) +
                     " do not know; set bending to hinges, or to none");
  if (sheet.seams().empty()) return;
  if (!solves(scene.integrator))
    throw InputError(scene.stem + ": the sheet has seams, which " +
                     std::string(name_of(integrator_names, scene.integrator)) +
                     " does not take; choose an implicit integrator");
  if (std::isfinite(scene.active_radius))
    throw InputError(scene.stem + ": the sheet has seams, which an active radius does not know; leave it out");
}

void hold_constrained_vertices(const std::vector<Pin>& pins, const std::vector<Traction>& tractions, Sheet& sheet) {
  for (std::size_t i = 0; i < sheet.vertex_slots(); ++i) {
    const VertexIndex v(i);
    if (!sheet.triangle_of_vertex(v).valid()) continue;
    const auto holds = [&](const auto& constraint) { return constraint.where.contains(sheet.rest(v)); };
    const bool on_border = sheet.on_border(sheet.first_outgoing(v));
    if (std::any_of(pins.begin(), pins.end(), holds) ||
        (on_border && std::any_of(tractions.begin(), tractions.end(), holds)))
      sheet.hold(v);
  }
}

std::vector<Curve> curves_of(const Scene::Cut& cut, const Sheet& sheet) {
  if (!cut.picked.picks.empty()) return {};
  return cut.family.empty() ? std::vector<Curve>{cut.curve} : make_case(cut.family, cut.seed, cut.index, sheet);
}

}  // namespace cutbench
