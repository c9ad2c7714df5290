// A step by several threads: the same bits as by one, through cuts.
#include <gtest/gtest.h>

#include <ostream>

#include "harness/base/random.h"
#include "harness/fem/time/stepper.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"
#include "tests/multigrid_helpers.h"

namespace cutbench {
namespace {

struct Kind {
  const char* method;
  const char* family;
  const char* solver;
  int steps, cuts;
  BendingKind bending = BendingKind::patches;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.method << ", " << kind.family << ", " << kind.solver; }

/// Large enough that its sweeps are shared.
Scene swinging(const Kind& kind) {
  Scene scene;
  scene.family = kind.family;
  scene.resolution = 2178;
  scene.material = {.density = 2.2, .stiffness = 1000, .poisson = 0.3, .bending = 4.2e-4, .mass_damping = 0.5};
  scene.physics.bending = kind.bending;
  scene.physics.gravity = {0, 0, -9.81};
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {0, infinite}}}});
  scene.solver.name = kind.solver;
  scene.step = 1.0 / 240;
  scene.duration = 10;
  Random random(4711);
  for (int k = 0; k < kind.cuts; ++k) {
    Scene::Cut& cut = scene.cuts.emplace_back();
    cut.time = (k + 0.5) * kind.steps / kind.cuts * scene.step;
    const Point2 from{random.between(0.1, 0.9), random.between(0.1, 0.9)};
    cut.curve = line(from, from + Point2{random.between(-0.2, 0.2), random.between(-0.2, 0.2)});
  }
  return scene;
}

struct Moved {
  std::vector<double> x, v;
  std::vector<int> iterations;
};

Moved moved(const Kind& kind, int threads) {
  Scene scene = swinging(kind);
  scene.solver.threads = threads;
  const auto motion = Simulation::start(scene);
  const auto method = find_method(kind.method).make(0);
  Moved result;
  EXPECT_EQ(motion->advance(kind.steps * scene.step, *method, {}).verdict, Verdict::ok);
  EXPECT_EQ(motion->made_cuts().size(), to_size(kind.cuts));
  result.x.assign(motion->positions().begin(), motion->positions().end());
  result.v.assign(motion->velocities().begin(), motion->velocities().end());
  for (const LoggedStep& logged : motion->steps()) result.iterations.push_back(logged.step.iterations);
  return result;
}

class Threads : public testing::TestWithParam<Kind> {};

TEST_P(Threads, MoveTheSameBits) {
  const Moved one = moved(GetParam(), 1);
  EXPECT_EQ(one.iterations.size(), to_size(GetParam().steps));
  for (const int threads : {2, 3, 7}) {
    const Moved several = moved(GetParam(), threads);
    EXPECT_TRUE(several.x == one.x && several.v == one.v) << threads;
    EXPECT_EQ(several.iterations, one.iterations) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(, Threads,
                         testing::Values(Kind{"conventional_split", "grid", "multigrid", to_int(scaled(600)), 20},
                                         Kind{"warp_and_refine", "delaunay", "multigrid", 40, 8},
                                         Kind{"cut_polygons", "grid", "multigrid", 40, 8},
                                         Kind{"phantom_node", "grid", "multigrid", 40, 4, BendingKind::hinges},
                                         Kind{"element_deletion", "grid", "cg", 40, 8}));

TEST(NumberOfThreads, IsAtLeastOne) {
  StepOptions options;
  options.solver.threads = 0;
  expect_refused([&] { const Stepper<3> stepper(options); }, "threads: 0");
}

}  // namespace
}  // namespace cutbench
