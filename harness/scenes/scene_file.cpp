#include "harness/scenes/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "harness/path/blade.h"
#include "harness/path/clear_of_seams.h"
#include "harness/scenes/scene_file_cuts.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

/// Zero where the key is not there.
Point3 read_vector(const TomlReader& reader, const char* key, const Physics& physics) {
  if (!reader.has(key)) return {};
  auto v = reader.list<double>(key);
  const std::string name = std::string("\"") + key + "\"";
  if (v.size() == 2 && physics.dimension == 2) v.push_back(0);
  if (v.size() != 3) reader.refuse(name + (physics.dimension == 2 ? " is [x, y]" : " is [x, y, z]"));
  if (!std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }))
    reader.refuse(name + " must be finite");
  if (physics.dimension == 2 && v[2] != 0)
    reader.refuse(name + " leaves the plane of a 2D scene; give [x, y], or set dimension = 3 in [physics]");
  return {v[0], v[1], v[2]};
}

Box read_box(const TomlReader& reader) {
  if (!reader.has("box")) return {};
  const auto points = reader.points("box");
  // NaN is not <= anything
  if (points.size() != 2 || !(points[0].x <= points[1].x && points[0].y <= points[1].y))
    reader.refuse("\"box\" is [[x0, y0], [x1, y1]] with x0 <= x1 and y0 <= y1");
  return {points[0], points[1]};
}

/// How a sheet's file is read.
struct SheetFile {
  MeshReading reading;
  double scale = 1;  ///< lengths of the file times this are m
};

SheetFile read_sheet(const TomlReader& file, const std::filesystem::path& folder, Scene& scene) {
  const TomlReader reader =
      file.section("sheet", {"family", "file", "scale", "size", "resolution", "rest", "triangulate", "sew"});
  if (reader.has("file")) {
    exclude(reader, "\"file\"", {"family", "size", "resolution"});
    scene.family.clear();
    const std::filesystem::path mesh = folder / reader.value<std::string>("file");
    if (std::error_code ignored; !std::filesystem::is_regular_file(mesh, ignored))
      reader.refuse("there is no file " + mesh.string() + "; \"file\" is relative to the scene's folder");
    scene.mesh_file = mesh.string();
    const RestFrom rest = reader.choice<RestFrom>("rest", RestFrom::automatic, rest_names);
    MeshReading reading{rest, reader.value<bool>("triangulate", false)};
    if (reader.has("sew")) reading.sew = reader.positive_or_zero("sew", 0);
    return {reading, reader.positive("scale", 1)};
  }
  exclude(reader, "\"family\"", {"rest", "triangulate", "sew"});
  if (reader.has("scale")) reader.refuse("\"scale\" is for a sheet from a \"file\"; give \"size\"");
  scene.family = reader.value<std::string>("family", scene.family);
  check_names({scene.family}, sheet_families(), reader.where + ": sheet");
  scene.size = reader.positive("size", scene.size);
  scene.resolution = reader.count("resolution", scene.resolution);
  try {
    squares_per_side(scene.resolution);
  } catch (const InputError& error) {
    reader.refuse(error.what());
  }
  return {};
}

MeshData read_scaled(const std::filesystem::path& file, const SheetFile& how) {
  MeshData mesh = read_mesh(file, how.reading);
  if (how.scale == 1) return mesh;
  for (Point2& p : mesh.rest) p = how.scale * p;
  for (Point3& p : mesh.deformed) p = how.scale * p;
  check_and_repair(mesh, file.filename().string() + ", scaled");
  return mesh;
}

void read_physics(const TomlReader& file, Scene& scene) {
  const TomlReader reader = file.section("physics", {"dimension", "plane", "strain", "stress_stiffness", "bending",
                                                     "mass", "mass_limit", "gravity", "active_radius"});
  Physics& p = scene.physics;
  p.dimension = reader.count("dimension", p.dimension);
  if (p.dimension != 2 && p.dimension != 3) reader.refuse("\"dimension\" is 2 (in the plane) or 3");
  p.plane = reader.choice<Plane>("plane", p.plane, plane_names);
  p.strain = reader.choice<Strain>("strain", p.strain, strain_names);
  p.stress_stiffness = reader.choice<StressStiffness>("stress_stiffness", p.stress_stiffness, stress_stiffness_names);
  if (p.strain == Strain::linear && reader.has("stress_stiffness"))
    reader.refuse("linear strain has no stiffness from stress; leave \"stress_stiffness\" out");
  p.bending = reader.choice<BendingKind>("bending", p.bending, bending_names());
  p.mass = reader.choice<Mass>("mass", p.mass, mass_names);
  p.mass_limit = reader.positive("mass_limit", p.mass_limit);
  if (reader.has("mass_limit") && !adds_mass(p.mass))
    reader.refuse("\"mass_limit\" is for mass = \"stabilised\" or \"scaled\"; leave it out");
  if (p.mass_limit < 1) reader.refuse("\"mass_limit\" must be 1 or more: the uncut sheet stays as it is");
  if (p.strain == Strain::springs && adds_mass(p.mass))
    reader.refuse("the mass of thin triangles is made for triangles, not for springs; set mass = \"lumped\"");
  p.gravity = read_vector(reader, "gravity", p);
  if (reader.has("active_radius")) scene.active_radius = reader.positive("active_radius", 0);
  if (p.bending != BendingKind::none && p.dimension == 2)
    reader.refuse("a 2D scene does not bend; set bending = \"none\", or dimension = 3");
}

Material read_material(const TomlReader& file, const Physics& physics) {
  const TomlReader reader =
      file.section("material", {"density", "stiffness", "poisson", "bending", "mass_damping", "stiffness_damping"});
  Material m;
  m.density = reader.positive("density", m.density);
  m.stiffness = reader.positive("stiffness", m.stiffness);
  m.poisson = reader.finite("poisson", m.poisson);
  const bool strain = physics.plane == Plane::strain;
  if (!(m.poisson > -1 && m.poisson < (strain ? 0.5 : 1)))
    reader.refuse(std::string("\"poisson\" must be between -1 and ") +
                  (strain ? "0.5 (plane strain)" : "1 (plane stress)") + ", both excluded");
  m.bending = reader.positive_or_zero("bending", m.bending);
  m.mass_damping = reader.positive_or_zero("mass_damping", m.mass_damping);
  m.stiffness_damping = reader.positive_or_zero("stiffness_damping", m.stiffness_damping);
  if (physics.bending != BendingKind::none && m.bending == 0)
    reader.refuse("[physics] asks for bending, so \"bending\" must be positive: the flexural rigidity in N m");
  return m;
}

std::array<Point3, 2> read_space_box(const TomlReader& reader) {
  const toml::array* const corners = reader.table["box"].as_array();
  if (corners == nullptr || corners->size() != 2)
    reader.refuse("with space = \"world\" give \"box\" = [[x0, y0, z0], [x1, y1, z1]]");
  return {read_place(reader, (*corners)[0].as_array(), "a corner of \"box\""),
          read_place(reader, (*corners)[1].as_array(), "a corner of \"box\"")};
}

ScenePin read_pin(const TomlReader& reader, const Physics& physics) {
  ScenePin p;
  if (reader.has("near") == reader.has("box")) reader.refuse("give either \"near\" = [x, y] or \"box\"");
  if (const auto space = reader.value<std::string>("space", "rest"); space == "world")
    p.in_space = read_space_box(reader);
  else if (space != "rest")
    reader.refuse("\"space\" is \"rest\" or \"world\"");
  else
    p.pin.where = read_box(reader);
  if (reader.has("near")) {
    const auto at = reader.list<double>("near");
    if (at.size() != 2 || !std::isfinite(at[0]) || !std::isfinite(at[1])) reader.refuse("\"near\" is a point [x, y]");
    p.near = Point2{at[0], at[1]};
  }
  const std::string all = physics.dimension == 2 ? "xy" : "xyz", axes = reader.value<std::string>("axes", all);
  p.pin.axes = {};
  for (char axis : axes) {
    const std::size_t i = all.find(axis);
    if (i == std::string::npos || std::exchange(p.pin.axes[i], true))
      reader.refuse("\"axes\" is \"" + axes + "\"; give each of \"" + all + "\" that is held once");
  }
  if (axes.empty()) reader.refuse("\"axes\" is empty; give those of \"" + all + "\" that are held");
  p.pin.displacement = read_vector(reader, "displacement", physics);
  p.pin.velocity = read_vector(reader, "velocity", physics);
  return p;
}

Traction read_traction(const TomlReader& reader, const Physics& physics) {
  if (!reader.has("force")) reader.refuse("\"force\" is missing: N per m of border");
  return {read_box(reader), read_vector(reader, "force", physics)};
}

void read_integrator(const TomlReader& file, Scene& scene) {
  const TomlReader reader = file.section("integrator", {"name", "step", "newton", "sweeps", "robust"});
  scene.integrator = reader.choice<Integrator>("name", scene.integrator, integrator_names);
  scene.step = reader.positive("step", scene.step);
  scene.newton = reader.count("newton", scene.newton);
  scene.robust = reader.value<bool>("robust", scene.integrator == Integrator::backward_euler && !reader.has("newton"));
  if (scene.robust && (!solves(scene.integrator) || scene.integrator == Integrator::equilibrium))
    reader.refuse("\"robust\" is for backward_euler and midpoint; leave it out");
  if (scene.robust && scene.newton > 1)
    reader.refuse("\"robust\" finds its own number of solves; leave \"newton\" out");
  scene.sweeps = reader.count("sweeps", scene.sweeps);
  if (scene.integrator == Integrator::symplectic_euler && scene.physics.mass == Mass::consistent)
    reader.refuse(
        "symplectic_euler solves nothing, so it needs mass = \"lumped\", \"stabilised\" or \"scaled\" in [physics]");
  if (scene.integrator == Integrator::symplectic_euler) exclude(reader, "symplectic_euler", {"newton"});
  const std::string name = name_of(integrator_names, scene.integrator);
  if (sweeps(scene.integrator)) {
    exclude(reader, name.c_str(), {"newton"});
    if (scene.physics.mass != Mass::lumped)
      reader.refuse(name + " solves no systems, so it needs mass = \"lumped\" in [physics]");
  } else {
    exclude(reader, "an integrator other than xpbd and vbd", {"sweeps"});
  }
  if (scene.integrator != Integrator::equilibrium) return;
  exclude(reader, "equilibrium, which takes no time", {"step"});
  exclude(file, "equilibrium, which takes no time", {"duration"});
  if (!reader.has("newton")) reader.refuse("equilibrium needs \"newton\": the largest number of linear solves");
}

SolverOptions read_solver(const TomlReader& file) {
  const TomlReader reader = file.section("solver", {"name", "tolerance", "max_iterations", "threads"});
  SolverOptions s;
  s.name = reader.value<std::string>("name", s.name);
  check_solver_names({s.name}, reader.where + ": solver");
  s.tolerance = reader.positive("tolerance", s.tolerance);
  if (s.tolerance >= 1) reader.refuse("\"tolerance\" must be below 1: at 1, x = 0 solves everything");
  s.max_iterations = reader.count("max_iterations", s.max_iterations);
  if (reader.has("threads")) s.threads = reader.count("threads", 1);
  return s;
}

/// The blade has cut all of a curve before the end. Where a picked one will be is not known yet.
void check_arrival(const Scene& scene, const Scene::Cut& cut, const std::string& where) {
  if (cut.speed == 0 || cut.curve.points.empty()) return;
  const double arrival = cut.time + Blade(cut.curve).length() / cut.speed;
  if (arrival <= scene.duration) return;
  char text[128];
  std::snprintf(text, sizeof text, "the blade arrives at %.4g s, after the end; make it faster or \"duration\" longer",
                arrival);
  throw InputError(where + text);
}

/// More than any run can make; their number must be a whole one.
constexpr double most_steps = 1e9;

/// What is wrong only together.
void check_times(const Scene& scene, const std::string& name) {
  const bool equilibrium = scene.integrator == Integrator::equilibrium;
  if (!equilibrium && scene.step > scene.duration)
    throw InputError(name + ": the first step ends after the duration; shorten \"step\" or lengthen \"duration\"");
  if (!equilibrium && scene.duration / scene.step > most_steps) {
    char text[128];
    std::snprintf(text, sizeof text, ": %.3g steps, more than 1e9; lengthen \"step\" or shorten \"duration\"",
                  scene.duration / scene.step);
    throw InputError(name + text);
  }
  for (std::size_t i = 0; i < scene.cuts.size(); ++i) {
    const double time = scene.cuts[i].time;
    const std::string where = name + ", cut " + std::to_string(i) + ": ";
    if (equilibrium && time > 0)
      throw InputError(where + "equilibrium takes no time, so \"time\" must be 0, or another integrator be chosen");
    if (equilibrium && scene.cuts[i].speed > 0)
      throw InputError(where + "equilibrium takes no time, so no blade has a \"speed\"; choose another integrator");
    if (!equilibrium && time >= scene.duration)
      throw InputError(where + "no step follows it; make \"time\" less than the scene's \"duration\"");
    check_arrival(scene, scene.cuts[i], where);
    if (i > 0 && time < scene.cuts[i - 1].time)
      throw InputError(where + "its \"time\" is before that of the cut above; list cuts in the order they are made");
  }
  if (!equilibrium) return;
  for (std::size_t i = 0; i < scene.pins.size(); ++i)
    if (scene.pins[i].pin.velocity != Point3{})
      throw InputError(name + ", pin " + std::to_string(i) +
                       ": equilibrium takes no time, so no pin has a \"velocity\"; give a \"displacement\"");
  if (scene.physics.gravity != Point3{} && scene.pins.empty())
    throw InputError(name + ": nothing holds the sheet against gravity in equilibrium; add [[pins]]");
}

void check_scene_suits_active_radius(const Scene& scene, const std::string& name) {
  if (!std::isfinite(scene.active_radius)) return;
  if (scene.integrator == Integrator::equilibrium)
    throw InputError(name + ": in equilibrium nothing has moved before the cut; leave \"active_radius\" out");
  const auto picked = [](const Scene::Cut& cut) { return !cut.picked.picks.empty(); };
  if (scene.cuts.empty())
    throw InputError(name + ": \"active_radius\" is that round cuts; add [[cuts]], or leave it out");
  if (std::any_of(scene.cuts.begin(), scene.cuts.end(), picked))
    throw InputError(name +
                     ": \"active_radius\" needs to know all cuts from the start; give them with space = \"rest\"");
}

Scene read_scene(const toml::table& table, const std::filesystem::path& file) {
  const TomlReader reader{table, file.string()};
  check_keys(table,
             {"effect", "truth", "duration", "sheet", "material", "physics", "pins", "tractions", "integrator",
              "solver", "cuts"},
             reader.where);
  Scene scene;
  scene.stem = file.stem().string();
  scene.effect = reader.value<std::string>("effect");
  scene.truth = reader.value<std::string>("truth");
  if (scene.effect.empty()) reader.refuse("\"effect\" is empty; say what the scene shows");
  if (scene.truth.empty()) reader.refuse("\"truth\" is empty; say what the scene is measured against");
  scene.duration = reader.positive("duration", scene.duration);
  const SheetFile sheet_file = read_sheet(reader, file.parent_path(), scene);
  read_physics(reader, scene);
  scene.material = read_material(reader, scene.physics);
  for (const auto& pin : reader.sections("pins", "pin", {"near", "box", "space", "axes", "displacement", "velocity"}))
    scene.pins.push_back(read_pin(pin, scene.physics));
  for (const auto& traction : reader.sections("tractions", "traction", {"box", "force"}))
    scene.tractions.push_back(read_traction(traction, scene.physics));
  read_integrator(reader, scene);
  scene.solver = read_solver(reader);
  scene.cuts = read_cuts(reader, file.parent_path(), sheet_file.scale);
  check_times(scene, reader.where);
  check_scene_suits_active_radius(scene, reader.where);
  if (scene.mesh_file.empty()) return scene;
  scene.mesh = read_scaled(scene.mesh_file, sheet_file);
  std::vector<AnyCurve> at_once;  // before anything moves
  for (const Scene::Cut& cut : scene.cuts)
    if (cut.time == 0 && !cut.picked.picks.empty()) at_once.emplace_back(cut.picked);
  clear_of_seams(*scene.mesh, scene.mesh_file, at_once, scene.stem);
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) { return read_scene(parse_toml(file), file); }

Scene read_scene_text(const std::string& text, const std::filesystem::path& name) {
  return read_scene(parse_toml_text(text, name.string()), name);
}

}  // namespace cutbench
