#include "harness/study/stability/try_point.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/records/metrics.h"
#include "harness/simulation/simulation.h"
#include "harness/study/stability/placed_cuts.h"

namespace cutbench {

namespace {

/// Of many cuts in a row only the last ones are judged: the points before them judged the others.
constexpr std::size_t most_judged = 4;

void put(const std::string& text, std::span<char> to) {
  std::fill(to.begin(), to.end(), '\0');
  text.copy(to.data(), to.size() - 1);
}

void pose(MeshData& mesh, const SweepPoint& point, double size) {
  for (Point3& p : mesh.deformed) {
    if (point.pose == "stretched") p.x *= point.pose_amount;
    if (point.pose == "rolled" && point.pose_amount > 0) {
      const double angle = point.pose_amount * std::numbers::pi / 180, radius = size / angle, at = p.x / radius;
      p = {radius * std::sin(at), p.y, radius * (1 - std::cos(at))};
    }
  }
}

/// In rest position: where the cut is judged and its eigenvalue is computed.
Sheet flat_sheet(Scene scene) {
  scene.mesh.reset();
  Sheet sheet(mesh_of(scene));
  hold_constrained_vertices(pins_of(scene, sheet), scene.tractions, sheet);
  return sheet;
}

Elasticity with_mass(Elasticity elasticity, const Scene& scene) {
  elasticity.mass = scene.physics.mass;
  if (adds_mass(elasticity.mass))
    elasticity.mass_limit = scene.physics.mass_limit * largest_element_eigenvalue(flat_sheet(scene), elasticity);
  return elasticity;
}

Elasticity elasticity_of(const Scene& scene) {
  return with_mass({.poisson = scene.material.poisson,
                    .plane = scene.physics.plane,
                    .bending = scene.physics.bending,
                    .bending_length2 = scene.material.bending / scene.material.stiffness},
                   scene);
}

class Point {
 public:
  Point(const Trial& trial, TrialResult& result)
      : trial_(trial), result_(result), scene_(scene_of(trial)), before_(flat_sheet(scene_)) {
    curves_ = placed_cut(trial.point->cut, trial.point->place, trial.seed, trial.index, before_);
    for (const Curve& curve : curves_) scene_.cuts.emplace_back().curve = curve;
  }

  void run() {
    at("the cut");
    if (!cut()) return;
    if (trial_.sweep->steps > 0) move();
  }

 private:
  /// \pre `name` is one of point_measures()
  double& measure(const char* name) {
    const auto& names = point_measures();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::logic_error(std::string(name) + " is not measured at points");
    return result_.measure[to_size(found - names.begin())];
  }
  void at(const std::string& what) { put("in " + what, result_.reason); }
  void conclude(Verdict verdict, const std::string& reason) {
    put(name_of(verdict), result_.verdict);
    put(reason, result_.reason);
  }

  /// False: the verdict is final.
  bool cut() {
    const MethodRow& row = *trial_.variant->row;
    const auto make = [&] { return row.make(trial_.variant->parameter); };
    Sheet sheet = before_;
    const std::size_t unjudged = curves_.size() > most_judged ? curves_.size() - 1 : 0;
    {
      Locator locator(sheet);
      Cutter cutter;
      const auto method = make();
      for (std::size_t i = 0; i < unjudged; ++i) cutter.cut(sheet, locator, curves_[i], *method, trial_.options);
    }
    JudgedSheet judged(sheet, row.promises, make());
    double us = 0, error = 0;
    for (std::size_t i = unjudged; i < curves_.size(); ++i) {
      const JudgedSheet::Finding finding = judged.cut(curves_[i], trial_.options);
      const CutOutcome& outcome = judged.outcome;
      put(name_of(outcome.status), result_.status);
      us += outcome.time_us.total();
      error = std::max(error, judged.judgement.incision_error);
      if (!finding.ok()) {
        conclude(finding.verdict, finding.reason);
        return false;
      }
      if (outcome.status == Status::refused) {
        conclude(Verdict::refused, outcome.reason);
        return false;
      }
      if (outcome.status == Status::failed) {
        conclude(Verdict::failed, outcome.reason);
        return false;
      }
    }
    conclude(Verdict::ok, "");
    measure("geometry_us") = us;
    measure("incision_error_h") = error / before_.mean_edge();
    measure_sheet(judged.sheet, *make());
    return true;
  }

  void measure_sheet(const Sheet& sheet, const CuttingMethod& method) {
    const Assessment a = assess(before_, sheet, {}, {});
    measure("triangles") = to_double(sheet.triangle_count());
    measure("vertices_added") = to_double(a.vertices_added);
    if (a.cut.triangles > 0) {
      measure("ar_max_cut") = a.cut.ar_max;
      measure("altitude_min_h_cut") = a.cut.altitude_min;
    }
    if (!trial_.point->eigenvalue) return;
    at("the eigenvalue");
    const Constraints constraints = constraints_of(method, before_, sheet);
    measure("eigenvalue_ratio") =
        largest_eigenvalue(sheet, constraints, with_mass({}, scene_)) / largest_eigenvalue(before_);
    measure("explicit_step_ratio") = explicit_step_of(scene_, sheet, constraints) / trial_.uncut_step_s;
    conclude(Verdict::ok, "");
  }

  void move() {
    at("the motion");
    const auto motion = moved(scene_);
    const SimulationOutcome outcome = motion->outcome();
    conclude(outcome.verdict, outcome.reason);
    for (const MotionCut& made : motion->made_cuts())
      if (made.cut.status == Status::refused) conclude(Verdict::refused, made.reason);
    note_steps(*motion);
    if (trial_.sweep->drift && outcome.verdict == Verdict::ok) note_drift(*motion);
  }

  std::unique_ptr<Simulation> moved(const Scene& scene) const {
    auto motion = Simulation::start(scene);
    motion->watch();
    const auto method = trial_.variant->row->make(trial_.variant->parameter);
    motion->advance(trial_.sweep->steps * scene.step, *method, trial_.options);
    return motion;
  }

  void note_steps(const Simulation& motion) {
    const auto& steps = motion.steps();
    measure("steps") = to_double(steps.size());
    if (steps.empty()) return;
    std::vector<double> us;
    double iterations = 0, residual = 0, cut_update = 0;
    for (const LoggedStep& s : steps) {
      us.push_back(s.step.time_us.total());
      cut_update += s.total_us() - us.back();
      iterations += s.step.iterations;
      residual = std::max(residual, s.step.residual);
    }
    measure("cut_update_us") = cut_update;
    measure("first_step_us") = us.front();
    std::nth_element(us.begin(), us.begin() + to_index(us.size() / 2), us.end());
    measure("step_us") = us[us.size() / 2];
    measure("iterations") = iterations / to_double(steps.size());
    measure("residual") = residual;
    if (!motion.budget()) return;
    const EnergyBudget::Gains gains = motion.budget()->gains();
    measure("energy_gain") = scene_.integrator == Integrator::symplectic_euler ? gains.unexplained : gains.remainder;
  }

  /// How far the fastest vertex is from where a direct solver would have brought it.
  void note_drift(const Simulation& motion) {
    at("the motion by a direct solver");
    Scene scene = scene_;
    scene.solver.name = "cholmod";
    const auto reference = moved(scene);
    conclude(Verdict::ok, "");
    if (reference->outcome().verdict != Verdict::ok) return;
    const Sheet a = motion.posed_sheet(), b = reference->posed_sheet();
    double farthest = 0;
    for (std::size_t v = 0; v < a.deformed_slots(); ++v) {
      const DeformedIndex d(v);
      if (a.rest_vertex(d).valid()) farthest = std::max(farthest, length(a.position(d) + -1 * b.position(d)));
    }
    measure("drift_h") = farthest / before_.mean_edge();
  }

  const Trial& trial_;
  TrialResult& result_;
  Scene scene_;
  Sheet before_;
  std::vector<Curve> curves_;
};

}  // namespace

const std::vector<std::string>& point_measures() {
  static const std::vector<std::string> names = [] {
    const std::vector<std::string> columns = record_columns("sweep", stability_metrics());
    const auto reason = std::find(columns.begin(), columns.end(), "reason");
    std::vector<std::string> behind(reason + 1, columns.end());
    if (behind.size() > most_point_measures) throw std::logic_error("most_point_measures is too small");
    return behind;
  }();
  return names;
}

Scene scene_of(const Trial& trial) {
  Scene scene = trial.point->scene;
  scene.stem = trial.sweep->name;
  scene.family = trial.sheet;
  scene.resolution = trial.resolution;
  scene.duration = std::numeric_limits<double>::infinity();
  scene.cuts.clear();
  if (trial.point->step_share > 0) scene.step = trial.point->step_share * trial.uncut_step_s;
  if (trial.point->pose != "flat") {
    MeshData mesh = mesh_of(scene);
    pose(mesh, *trial.point, scene.size);
    scene.mesh = std::move(mesh);
  }
  return scene;
}

double explicit_step_of(const Scene& scene, const Sheet& sheet, const Constraints& constraints) {
  return explicit_step_limit(largest_eigenvalue(sheet, constraints, elasticity_of(scene)), scene.material);
}

void try_point(const Trial& trial, TrialResult& result) { Point(trial, result).run(); }

}  // namespace cutbench
