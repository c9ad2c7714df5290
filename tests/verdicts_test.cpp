// Each verdict on the steps of a simulation is provoked, by every integrator that can come to it, and none is given
// where nothing is wrong.
#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/simulation/simulation.h"
#include "harness/simulation/turned_over.h"
#include "methods/registry.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

/// A strip of skin that falls from rest, held at its left side; it is cut in the middle of the time.
Scene falling(Integrator integrator, double step, int steps) {
  Scene scene;
  scene.resolution = 200;
  scene.integrator = integrator;
  scene.step = step;
  scene.duration = step * steps;
  scene.material = {.density = 2.2, .stiffness = 1000, .poisson = 0.45};
  scene.physics.gravity = {0, 0, -9.81};
  scene.solver.name = "cholmod";
  scene.pins.push_back({{}, {.where = {{0, 0}, {0, 1}}}});
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.time = scene.duration / 2;
  cut.curve = line({0.31, 0.2}, {0.48, 0.83});
  return scene;
}

std::unique_ptr<Simulation> run(const Scene& scene, const std::string& method = "edge_release") {
  auto motion = Simulation::start(scene);
  motion->watch();
  motion->advance(scene.duration, *find_method(method).make(find_method(method).parameter.value), {});
  return motion;
}

TEST(Verdict, OkWhereNothingIsWrong) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint, Integrator::symplectic_euler}) {
    Scene scene = falling(integrator, integrator == Integrator::symplectic_euler ? 1e-4 : 1e-3, 200);
    for (const double damping : {0.0, 1e-4}) {
      scene.material.stiffness_damping = damping;
      const auto motion = run(scene);
      EXPECT_EQ(motion->outcome().verdict, Verdict::ok)
          << name_of(integrator_names, integrator) << motion->outcome().reason;
      EXPECT_EQ(motion->made_cuts().size(), 1u);
      ASSERT_NE(motion->budget(), nullptr);
      EXPECT_EQ(motion->budget()->rows().size(), motion->steps().size() + 1);
    }
  }
}

/// Above its limit an explicit step first gains energy, then overflows: both are said.
TEST(Verdict, AnExplicitStepBeyondItsLimit) {
  Scene scene = falling(Integrator::symplectic_euler, 1e-4, 4000);
  const double limit = Simulation::start(scene)->step_limits().membrane;
  scene.step = 1.2 * limit;
  scene.duration = 4000 * scene.step;
  const auto motion = Simulation::start(scene);
  motion->watch();
  const auto method = find_method("edge_release").make(0);
  while (motion->outcome().verdict == Verdict::ok && motion->time() < scene.duration / 2)
    motion->advance(motion->time() + scene.step, *method, {});
  EXPECT_EQ(motion->outcome().verdict, Verdict::energy_growth) << motion->outcome().reason;
  const double found = motion->outcome().time;
  motion->advance(scene.duration, *method, {});
  EXPECT_EQ(motion->outcome().verdict, Verdict::not_finite) << motion->outcome().reason;
  EXPECT_GT(motion->outcome().time, found);
  EXPECT_LT(motion->outcome().time, scene.duration) << "it ended the simulation";
}

/// One linear solve per step, far too long for a sheet as stiff as that: damping and losses don't hide it.
TEST(Verdict, AnImplicitStepThatGainsEnergy) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint}) {
    Scene scene = falling(integrator, 0.04, 25);
    scene.material.stiffness = 1e5;
    scene.material.density = 0.2;
    EXPECT_EQ(run(scene)->outcome().verdict, Verdict::energy_growth) << name_of(integrator_names, integrator);
  }
}

TEST(Verdict, InvertedInThePlane) {
  Scene scene = falling(Integrator::backward_euler, 0.01, 10);
  scene.physics.dimension = 2;
  scene.physics.gravity = {};
  scene.pins.push_back({{}, {.where = {{1, 0}, {1, 1}}, .displacement = {-1.5, 0, 0}}});
  const auto motion = run(scene);
  EXPECT_EQ(motion->outcome().verdict, Verdict::inverted) << motion->outcome().reason;
  EXPECT_NEAR(motion->time(), scene.duration, 1e-9) << "it goes on";
}

/// A crease turns nothing over, a vertex pulled across its ring does, a lip pulled across the other does not.
TEST(Verdict, InvertedInSpace) {
  Sheet sheet(make_sheet("grid", 8));
  Field x = Field::Zero(to_index(3 * sheet.deformed_slots()));
  const auto place = [&](auto where) {
    for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
      const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(v)));
      x.segment<3>(to_index(3 * v)) = where(p);
    }
  };
  place([](Point2 p) { return Eigen::Vector3d(p.x, p.y, 0); });
  EXPECT_EQ(turned_over(sheet, ElementTable(sheet), x, 3).triangles, 0u);
  place([](Point2 p) { return Eigen::Vector3d(p.x < 0.5 ? p.x : 1 - p.x, p.y, p.x < 0.5 ? 0 : 1e-3); });
  EXPECT_EQ(turned_over(sheet, ElementTable(sheet), x, 3).triangles, 0u) << "folded along mesh lines";
  place([](Point2 p) { return Eigen::Vector3d(p.x == 0.5 && p.y == 0.5 ? 0.9 : p.x, p.y, 0); });
  const TurnedOver turned = turned_over(sheet, ElementTable(sheet), x, 3);
  EXPECT_GE(turned.triangles, 1u);
  EXPECT_GT(turned.area, 0);
}

/// Triangles that share one edge are folded on each other without strain, or with it; so is a strip along each edge.
TEST(Verdict, AFoldIsNotInverted) {
  const MeshData pair{
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}};
  const Sheet sheet(pair);
  Field x(12);
  for (const double stretch : {1.0, 3.0}) {
    x << 0, 0, 0, stretch, 0, 0, stretch, stretch, 0, 0.95 * stretch, 0.05 * stretch, 0.1 * stretch;
    EXPECT_EQ(turned_over(sheet, ElementTable(sheet), x, 3).triangles, 0u) << stretch;
  }
  MeshData strip;
  for (int i = 0; i < 8; ++i) {
    strip.rest.push_back({i / 2.0, i % 2 == 0 ? 0.0 : 1.0});
    if (i < 2) continue;
    if (i % 2 == 0)
      strip.triangles.push_back({i - 2, i, i - 1});
    else
      strip.triangles.push_back({i - 2, i - 1, i});
  }
  for (const Point2 p : strip.rest) strip.deformed.push_back({p.x, p.y, 0});
  const Sheet zigzag(strip);
  Field y(24);
  // All triangles on one: each vertex is at one of three corners.
  for (int i = 0; i < 8; ++i) {
    const Point2 p = strip.rest[to_size(i % 3)];
    y.segment<3>(3 * i) = Eigen::Vector3d(p.x, p.y, 0);
  }
  EXPECT_EQ(turned_over(zigzag, ElementTable(zigzag), y, 3).triangles, 0u);
}

TEST(Verdict, SolverStalled) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint}) {
    Scene scene = falling(integrator, 0.01, 10);
    scene.solver = {.name = "cg", .tolerance = 1e-15, .max_iterations = 1};
    const auto motion = run(scene);
    EXPECT_EQ(motion->outcome().verdict, Verdict::solver_stalled);
    EXPECT_EQ(motion->time(), 0) << "no state is made of it";
  }
}

/// Steps of a second of a very stiff sheet that falls: three iterations are not enough.
TEST(Verdict, NewtonFailed) {
  Scene scene = falling(Integrator::backward_euler, 1, 4);
  scene.material.stiffness = 1e9;
  scene.newton = 3;
  EXPECT_EQ(run(scene)->outcome().verdict, Verdict::newton_failed);
  scene = falling(Integrator::equilibrium, 1, 1);
  scene.newton = 1;
  scene.physics.dimension = 2;
  scene.physics.gravity = {0, -9.81, 0};
  scene.cuts.clear();
  EXPECT_EQ(run(scene)->outcome().verdict, Verdict::newton_failed);
}

/// At rest, and where it moves slowly, Newton's method converges until rounding is left: no failure.
TEST(Verdict, NewtonConverges) {
  for (const int newton : {2, 3, 12}) {
    Scene scene = falling(Integrator::backward_euler, 0.002, 60);
    scene.newton = newton;
    EXPECT_EQ(run(scene, "conventional_split")->outcome().verdict, Verdict::ok) << newton;
    scene.physics.gravity = {};
    EXPECT_EQ(run(scene, "conventional_split")->outcome().verdict, Verdict::ok) << newton << " at rest";
  }
}

TEST(Verdict, TimedOut) {
  const std::size_t steps = 100'000'000;  // hours, and the clock of the process may tick in hundredths of a second
  const Scene scene = falling(Integrator::symplectic_euler, 1e-4, to_int(steps));
  const auto motion = Simulation::start(scene);
  motion->limit_time(1e-9);
  EXPECT_EQ(motion->advance(scene.duration, *find_method("edge_release").make(0), {}).verdict, Verdict::timed_out);
  EXPECT_EQ(motion->outcome().verdict, Verdict::timed_out);
  EXPECT_GE(motion->steps().size(), 1u);
  EXPECT_LT(motion->steps().size(), steps);
}

/// At rest nothing but rounding has energy, and that is no growth.
TEST(Verdict, ASheetAtRestGainsNothing) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint, Integrator::symplectic_euler}) {
    Scene scene = falling(integrator, 1e-4, 50);
    scene.physics.gravity = {};
    scene.physics.bending = BendingKind::patches;
    scene.material.bending = 4.2e-4;
    EXPECT_EQ(run(scene, "conventional_split")->outcome().verdict, Verdict::ok)
        << name_of(integrator_names, integrator);
  }
}

}  // namespace
}  // namespace cutbench
