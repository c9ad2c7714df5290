// Pins and forces that a caller sets between two steps.
#include <gtest/gtest.h>

#include "harness/base/errors.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"

namespace cutbench {
namespace {

const Box left_side{{0, 0}, {0, 1}};

/// Held at its left side, it falls.
Scene falling(int dimension = 3) {
  Scene scene;
  scene.resolution = 200;
  scene.material = {.density = 0.5, .stiffness = 500, .poisson = 0.3, .bending = 1e-3, .mass_damping = 0.5};
  scene.physics.dimension = dimension;
  scene.physics.gravity = {0, -9.81, 0};
  scene.pins.push_back({.near = {}, .pin = {.where = left_side}});
  return scene;
}

void make_steps(Simulation& simulation, int n) {
  for (int i = 0; i < n; ++i) ASSERT_EQ(simulation.step().verdict, Verdict::ok);
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(PinsAndForces, NoForceIsNoForce) {
  for (const int dimension : {2, 3}) {
    const auto one = Simulation::start(falling(dimension)), other = Simulation::start(falling(dimension));
    for (int i = 0; i < 10; ++i) {
      other->pull(std::vector<double>(other->positions().size()));
      other->pull({});
      make_steps(*one, 1);
      make_steps(*other, 1);
    }
    EXPECT_EQ(largest_difference(one->positions(), other->positions()), 0);
    EXPECT_EQ(largest_difference(one->velocities(), other->velocities()), 0);
  }
}

TEST(PinsAndForces, WeightsAsForcesAreGravity) {
  const auto falls = Simulation::start(falling());
  Scene weightless = falling();
  weightless.physics.gravity = {};
  const auto pulled = Simulation::start(weightless);
  const Sheet& sheet = pulled->sheet();
  std::vector<double> force(pulled->positions().size());
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const auto [a, b, c] = sheet.corners(TriangleIndex(t));
    for (const DeformedIndex d : sheet.triangle(TriangleIndex(t)).deformed)
      force[3 * d() + 1] -= 9.81 * 0.5 * cross(b - a, c - a) / 6;
  }
  pulled->watch();
  pulled->pull(force);
  make_steps(*falls, 40);
  make_steps(*pulled, 40);
  EXPECT_LT(largest_difference(falls->positions(), pulled->positions()), 1e-9);
  EXPECT_EQ(pulled->outcome().verdict, Verdict::ok) << pulled->outcome().reason;
}

TEST(PinsAndForces, WorkOfForcesIsInTheBudget) {
  const auto simulation = Simulation::start(falling());
  simulation->watch();
  std::vector<double> force(simulation->positions().size());
  for (int i = 0; i < 40; ++i) {
    for (std::size_t k = 2; k < force.size(); k += 3) force[k] = i % 10 < 5 ? 0.01 : -0.01;
    simulation->pull(force);
    make_steps(*simulation, 1);
  }
  EXPECT_EQ(simulation->outcome().verdict, Verdict::ok) << simulation->outcome().reason;
}

TEST(PinsAndForces, ForcesAfterACut) {
  const auto simulation = Simulation::start(falling());
  const std::vector<double> force(simulation->positions().size(), 0.001);
  simulation->pull(force);
  make_steps(*simulation, 2);
  const MethodRow& row = find_method("conventional_split");
  const auto method = row.make(row.parameter.value);
  const Curve slit{Curve::Kind::polyline, false, {{0.31, 0.22}, {0.48, 0.83}}};
  EXPECT_EQ(simulation->cut_now({&slit, 1}, *method).verdict, Verdict::ok);
  make_steps(*simulation, 2);
  EXPECT_THROW(simulation->pull(force), InputError);  // the sheet has more vertices now
  simulation->pull(std::vector<double>(simulation->positions().size()));
}

TEST(PinsAndForces, RefusesWhatIsNoForce) {
  const auto simulation = Simulation::start(falling());
  std::vector<double> force(simulation->positions().size());
  force[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulation->pull(force), InputError);
}

TEST(PinsAndForces, PinsMoveFromWhereTheyAre) {
  const auto simulation = Simulation::start(falling());
  simulation->watch();
  make_steps(*simulation, 10);
  const std::vector<double> start(simulation->positions().begin(), simulation->positions().end());
  simulation->hold({{.where = left_side, .velocity = {0.1, 0, 0}}});
  make_steps(*simulation, 24);  // 0.1 s
  const Sheet& sheet = simulation->sheet();
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (sheet.rest(sheet.rest_vertex(DeformedIndex(d))).x == 0) {
      EXPECT_NEAR(simulation->positions()[3 * d] - start[3 * d], 0.01, 1e-12);
      EXPECT_EQ(simulation->positions()[3 * d + 1], start[3 * d + 1]);
    }
  EXPECT_EQ(simulation->outcome().verdict, Verdict::ok) << simulation->outcome().reason;
}

/// What a solver keeps of the matrix from step to step follows the pins.
TEST(PinsAndForces, EverySolverSeesNewPins) {
  std::vector<double> wanted;
  for (const std::string& solver : solver_names()) {
    Scene scene = falling();
    scene.solver.name = solver;
    scene.solver.tolerance = 1e-12;
    const auto simulation = Simulation::start(scene);
    make_steps(*simulation, 3);
    simulation->hold({{.where = {{0.4, 0.9}, {1, 1}}, .velocity = {0, 0, 0.2}}});
    make_steps(*simulation, 5);
    simulation->hold({});
    make_steps(*simulation, 2);
    const auto x = simulation->positions();
    if (wanted.empty()) wanted.assign(x.begin(), x.end());
    EXPECT_LT(largest_difference(x, wanted), 1e-8) << solver;
  }
}

}  // namespace
}  // namespace cutbench
