// Steps that go on with Newton's method until their energy is right: a stiff sheet that springs open gains none, and
// where one solve is enough nothing changes.
#include <gtest/gtest.h>

#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// Stretched by 5 %, cut from side to side but for a rest, and let go.
Scene springs_open(double stiffness, double step, Integrator integrator = Integrator::backward_euler) {
  Scene scene;
  scene.family = "delaunay";
  scene.mesh = make_sheet("delaunay", 20);
  for (Point3& p : scene.mesh->deformed) p.x *= 1.05;
  scene.material = {.density = 2.2, .stiffness = stiffness, .poisson = 0.45, .bending = 4.2e-4};
  scene.physics.bending = BendingKind::patches;
  scene.physics.gravity = {0, 0, -9.81};
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {0, infinite}}}});
  scene.pins.push_back({.near = {}, .pin = {.where = {{1, -infinite}, {infinite, infinite}}}});
  scene.integrator = integrator;
  scene.step = step;
  scene.solver.name = "multigrid";
  for (const double x : {0.31, 0.52, 0.74}) {
    Scene::Cut& cut = scene.cuts.emplace_back();
    cut.curve = {Curve::Kind::polyline, false, {{x, 0.13}, {x + 0.04, 0.87}}};
  }
  return scene;
}

struct Ran {
  Verdict verdict;
  std::vector<double> positions;
  int solves = 0;
};

Ran run(Scene scene, bool robust, int steps, const char* method) {
  scene.robust = robust;
  const auto motion = Simulation::start(scene);
  const MethodRow row = find_method(method);
  const auto tool = row.make(row.parameter.value);
  motion->watch();
  motion->advance(steps * scene.step, *tool, {});
  Ran result{motion->outcome().verdict, {motion->positions().begin(), motion->positions().end()}};
  for (const LoggedStep& step : motion->steps()) result.solves += step.step.newton;
  return result;
}

TEST(RobustStep, AStiffSheetGainsNoEnergy) {
  std::size_t gained = 0;
  for (const char* method : {"conventional_split", "cut_polygons", "adaptive_remesh", "delaunay_refine"})
    for (const double step : {1.0 / 60, 1.0 / 240}) {
      const Scene scene = springs_open(10000, step);
      gained += run(scene, false, 8, method).verdict == Verdict::energy_growth;
      EXPECT_EQ(run(scene, true, 8, method).verdict, Verdict::ok) << method << ", " << step;
    }
  EXPECT_GE(gained, 3u);  // else this tests nothing
}

/// Held at one side, it swings down from the horizontal: each step gains little, and all of them gain.
TEST(RobustStep, GainsOfManyStepsDoNotAddUp) {
  for (const double stiffness : {2000.0, 10000.0})
    for (const double damping : {0.0, 0.01, 0.05})  // its matrix changed under the solves, which ran in circles
      for (const char* method : {"", "conventional_split", "phantom_node", "cut_polygons"}) {
        Scene scene = springs_open(stiffness, 1.0 / 60);
        scene.mesh = make_sheet("grid", 20);
        scene.pins.pop_back();
        scene.material.stiffness_damping = damping;
        scene.cuts.clear();
        if (*method) {
          Scene::Cut& cut = scene.cuts.emplace_back();
          cut.time = 0.3;
          cut.curve = {Curve::Kind::polyline, false, {{0.45, -0.1}, {0.52, 0.6}}};
        }
        scene.robust = true;
        const auto motion = Simulation::start(scene);
        const MethodRow row = find_method(*method ? method : "conventional_split");
        const auto tool = row.make(row.parameter.value);
        motion->watch();
        motion->advance(1, *tool, {});
        EXPECT_EQ(motion->outcome().verdict, Verdict::ok) << stiffness << ", " << damping << ", " << method;
        ASSERT_NE(motion->budget(), nullptr);
        EXPECT_LT(motion->budget()->gains().remainder, 0.025) << stiffness << ", " << damping << ", " << method;
      }
}

TEST(RobustStep, WhereOneSolveIsEnoughNothingChanges) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint}) {
    Scene scene = springs_open(100, 1e-4, integrator);
    scene.material.stiffness_damping = 1e-4;
    scene.material.mass_damping = 0.3;
    const Ran plain = run(scene, false, 6, "conventional_split"), robust = run(scene, true, 6, "conventional_split");
    EXPECT_EQ(plain.positions, robust.positions);
    EXPECT_EQ(robust.solves, 6);
  }
}

}  // namespace
}  // namespace cutbench
