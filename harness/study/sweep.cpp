#include "harness/study/sweep.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/scenes/scene_file.h"

namespace cutbench {

namespace {

constexpr const char* pose_names[] = {"flat", "rolled", "stretched"};

std::string text_of(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

template <auto member>
std::string get_text(const SweepPoint& p) {
  return p.*member;
}
template <auto member>
std::string get_number(const SweepPoint& p) {
  return text_of(p.*member);
}

// What several settings do.
double number_of(const TomlReader& r, const char* key) { return r.finite(key, 0); }

constexpr SweepSetting settings[] = {
    {"cut", get_text<&SweepPoint::cut>,
     [](const TomlReader& r, SweepPoint& p) { p.cut = r.value<std::string>("cut"); }},
    {"place", get_number<&SweepPoint::place>,
     [](const TomlReader& r, SweepPoint& p) { p.place = r.positive_or_zero("place", 0); }},
    {"pose", get_text<&SweepPoint::pose>,
     [](const TomlReader& r, SweepPoint& p) {
       p.pose = r.value<std::string>("pose");
       check_names({p.pose}, pose_names, r.where + ": pose");
     }},
    {"pose_amount", get_number<&SweepPoint::pose_amount>,
     [](const TomlReader& r, SweepPoint& p) { p.pose_amount = number_of(r, "pose_amount"); }},
    {"step_share", get_number<&SweepPoint::step_share>,
     [](const TomlReader& r, SweepPoint& p) {
       p.step_share = r.positive("step_share", 0);
       p.scene.integrator = Integrator::symplectic_euler;
     }},
    {"integrator", [](const SweepPoint& p) -> std::string { return name_of(integrator_names, p.scene.integrator); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.integrator = r.choice<Integrator>("integrator", p.scene.integrator, integrator_names);
       if (sweeps(p.scene.integrator))
         r.refuse("sweeps judge energies, which " + std::string(name_of(integrator_names, p.scene.integrator)) +
                  " does not account for; choose another integrator");
     }},
    {"step_s", [](const SweepPoint& p) { return text_of(p.scene.step); },
     [](const TomlReader& r, SweepPoint& p) { p.scene.step = r.positive("step_s", 0); }},
    {"newton", [](const SweepPoint& p) { return std::to_string(p.scene.newton); },
     [](const TomlReader& r, SweepPoint& p) { p.scene.newton = r.count("newton", 1); }},
    {"solver", [](const SweepPoint& p) { return p.scene.solver.name; },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.solver.name = r.value<std::string>("solver");
       check_solver_names({p.scene.solver.name}, r.where + ": solver");
     }},
    {"tolerance", [](const SweepPoint& p) { return text_of(p.scene.solver.tolerance); },
     [](const TomlReader& r, SweepPoint& p) { p.scene.solver.tolerance = r.positive("tolerance", 0); }},
    {"max_iterations", [](const SweepPoint& p) { return std::to_string(p.scene.solver.max_iterations); },
     [](const TomlReader& r, SweepPoint& p) { p.scene.solver.max_iterations = r.count("max_iterations", 1); }},
    {"stiffness_n_m", [](const SweepPoint& p) { return text_of(p.scene.material.stiffness); },
     [](const TomlReader& r, SweepPoint& p) { p.scene.material.stiffness = r.positive("stiffness_n_m", 0); }},
    {"poisson", [](const SweepPoint& p) { return text_of(p.scene.material.poisson); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.material.poisson = number_of(r, "poisson");
       if (!(p.scene.material.poisson >= 0 && p.scene.material.poisson < 0.5))
         r.refuse("\"poisson\" must be from 0 to below 0.5");
     }},
    {"mass_damping_1_s", [](const SweepPoint& p) { return text_of(p.scene.material.mass_damping); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.material.mass_damping = r.positive_or_zero("mass_damping_1_s", 0);
     }},
    {"stiffness_damping_s", [](const SweepPoint& p) { return text_of(p.scene.material.stiffness_damping); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.material.stiffness_damping = r.positive_or_zero("stiffness_damping_s", 0);
     }},
    {"stress_stiffness",
     [](const SweepPoint& p) -> std::string {
       return name_of(stress_stiffness_names, p.scene.physics.stress_stiffness);
     },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.physics.stress_stiffness =
           r.choice<StressStiffness>("stress_stiffness", p.scene.physics.stress_stiffness, stress_stiffness_names);
     }},
    {"mass", [](const SweepPoint& p) -> std::string { return name_of(mass_names, p.scene.physics.mass); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.physics.mass = r.choice<Mass>("mass", p.scene.physics.mass, mass_names);
     }},
    {"bending", [](const SweepPoint& p) -> std::string { return name_of(p.scene.physics.bending); },
     [](const TomlReader& r, SweepPoint& p) {
       p.scene.physics.bending = r.choice<BendingKind>("bending", p.scene.physics.bending, bending_names());
     }},
};

/// The values of a setting: a list, or one.
toml::array values_of(const TomlReader& sweep, const char* key) {
  if (sweep.table[key].is_array()) return sweep.array(key);
  toml::array one;
  sweep.table[key].visit([&](const auto& node) { one.push_back(node); });
  return one;
}

/// Every constraint_matrix: the last setting varies fastest.
std::vector<SweepPoint> read_points(const TomlReader& sweep, const Scene& scene) {
  std::vector<SweepPoint> points{{.scene = scene}};
  for (const SweepSetting& setting : settings) {
    if (!sweep.has(setting.name)) continue;
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : points)
      for (const toml::node& value : values_of(sweep, setting.name)) {
        toml::table one;
        one.insert(setting.name, value);
        setting.set(TomlReader{one, sweep.where}, more.emplace_back(point));
      }
    points = std::move(more);
  }
  return points;
}

/// One of the points that share a cut and a material will do.
void choose_for_eigenvalue(std::vector<SweepPoint>& points) {
  const auto known_from = [](const SweepPoint& p) {
    const Material& m = p.scene.material;
    return std::tuple(p.cut, p.place, m.stiffness, m.poisson, m.bending, p.scene.physics.bending, p.scene.physics.mass);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].eigenvalue = std::none_of(points.begin(), points.begin() + to_index(i), [&](const SweepPoint& earlier) {
      return known_from(earlier) == known_from(points[i]);
    });
}

}  // namespace

std::span<const SweepSetting> sweep_settings() { return settings; }
std::span<const char* const> poses() { return pose_names; }

Scene read_scene_for_experiment(const std::filesystem::path& file) {
  Scene scene = read_scene(file);
  if (std::isfinite(scene.active_radius))
    throw InputError(
        file.string() +
        ": \"active_radius\" is that round the scene's own cuts, but an experiment makes others; leave it out");
  return scene;
}

std::vector<Sweep> read_sweeps(const TomlReader& experiment, const std::filesystem::path& folder) {
  std::vector<std::string> known{"name",  "scene", "sheets", "methods",   "resolutions",
                                 "cases", "steps", "drift",  "eigenvalue"};
  for (const SweepSetting& setting : settings) known.emplace_back(setting.name);
  std::vector<Sweep> sweeps;
  for (const TomlReader& r : experiment.sections("sweeps", "sweep", known)) {
    Sweep& s = sweeps.emplace_back();
    s.name = r.value<std::string>("name");
    if (r.has("sheets")) s.sheets = r.list<std::string>("sheets");
    if (r.has("methods")) s.methods = r.list<std::string>("methods");
    if (r.has("resolutions"))
      for (const auto n : r.list<std::int64_t>("resolutions")) s.resolutions.push_back(to_int(n));
    s.cases = r.count("cases", s.cases);
    s.steps = r.count("steps", s.steps, 0);
    s.drift = r.value<bool>("drift", s.drift);
    s.scene_file = folder / r.value<std::string>("scene");
    s.points = read_points(r, read_scene_for_experiment(s.scene_file));
    if (r.value<bool>("eigenvalue", false)) choose_for_eigenvalue(s.points);
  }
  return sweeps;
}

}  // namespace cutbench
