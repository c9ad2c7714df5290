// A cut in a simulation in memory, between two steps: bit for bit that of a scene which knows it from the start.
#include <gtest/gtest.h>

#include <ostream>

#include "harness/cases/cut_families.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

const Curve slit{Curve::Kind::polyline, false, {{0.31, 0.22}, {0.48, 0.83}}};
const Curve second{Curve::Kind::bezier, false, {{0.55, 0.25}, {0.95, 0.35}, {0.95, 0.65}, {0.6, 0.8}}};
const Curve beside{Curve::Kind::polyline, false, {{3, 3}, {4, 4}}};
const Curve far_too_long{Curve::Kind::polyline, false, {{0.5, 0.5}, {1e5, 0.5}}};

struct Kind {
  const char* method;
  double parameter;
  int dimension;
  BendingKind bending;
  Integrator integrator;
  const char* solver;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.method << ", " << name_of(integrator_names, kind.integrator);
}

/// Held at its left side, it falls.
Scene falling(const Kind& kind) {
  Scene scene;
  scene.family = "delaunay";
  scene.resolution = 200;
  scene.material = {.density = 2.2, .stiffness = 1000, .poisson = 0.3, .bending = 1e-3, .mass_damping = 0.5};
  scene.physics.dimension = kind.dimension;
  scene.physics.bending = kind.bending;
  scene.physics.gravity = {0, -9.81, kind.dimension == 3 ? -3.0 : 0.0};
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {0, infinite}}}});
  scene.integrator = kind.integrator;
  scene.solver.name = kind.solver;
  scene.step = kind.integrator == Integrator::symplectic_euler ? 1e-4 : 1.0 / 240;
  scene.duration = 1;
  return scene;
}

void add_cut(Scene& scene, double steps, const Curve& curve) {
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.time = steps * scene.step;
  cut.curve = curve;
}

std::unique_ptr<CuttingMethod> method_of(const Kind& kind) { return find_method(kind.method).make(kind.parameter); }

std::unique_ptr<Simulation> start(const Scene& scene) {
  auto motion = Simulation::start(scene);
  motion->watch();
  return motion;
}

void step(Simulation& motion, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_EQ(motion.step().verdict, Verdict::ok);
}

void expect_same_bits(const Balance& a, const Balance& b) {
  EXPECT_EQ(a.energy.membrane, b.energy.membrane);
  EXPECT_EQ(a.energy.bending, b.energy.bending);
  EXPECT_EQ(a.energy.kinetic, b.energy.kinetic);
  EXPECT_EQ(a.energy.potential, b.energy.potential);
  EXPECT_EQ(a.momentum, b.momentum);
  EXPECT_EQ(a.angular_momentum, b.angular_momentum);
  EXPECT_EQ(a.residual, b.residual);
}

/// Sheet, places, speeds and energies of all steps.
void expect_same_bits(Simulation& a, Simulation& b) {
  EXPECT_EQ(a.time(), b.time());
  const MeshData here = a.posed_sheet().to_mesh_data(), there = b.posed_sheet().to_mesh_data();
  EXPECT_EQ(here.rest, there.rest);
  EXPECT_EQ(here.deformed, there.deformed);
  EXPECT_EQ(here.triangles, there.triangles);
  expect_same_bits(a.balance(), b.balance());
  ASSERT_EQ(a.budget() != nullptr, b.budget() != nullptr);
  if (!a.budget()) return;
  ASSERT_EQ(a.budget()->rows().size(), b.budget()->rows().size());
  EXPECT_EQ(a.budget()->rows().back().jumps, b.budget()->rows().back().jumps);
  EXPECT_EQ(a.budget()->rows().back().remainder, b.budget()->rows().back().remainder);
}

class CutNow : public testing::TestWithParam<Kind> {};

TEST_P(CutNow, IsTheScenesOwnCutAtThatMoment) {
  Scene scene = falling(GetParam());
  const auto live = start(scene);
  add_cut(scene, 5.5, slit);
  add_cut(scene, 9.5, second);
  const auto told = start(scene);
  const auto method = method_of(GetParam()), its_own = method_of(GetParam());
  ASSERT_EQ(told->advance(16 * scene.step, *its_own, {}).verdict, Verdict::ok);

  step(*live, 5);
  const MotionCut first = live->cut_now({&slit, 1}, *method);
  EXPECT_EQ(first.cut.status, Status::ok) << first.reason;
  EXPECT_GT(first.cut.crossed_triangles, 5u);
  step(*live, 4);
  EXPECT_EQ(live->cut_now({&second, 1}, *method).cut.status, Status::ok);
  step(*live, 7);
  expect_same_bits(*told, *live);
  ASSERT_EQ(live->made_cuts().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    expect_same_bits(told->made_cuts()[i].before, live->made_cuts()[i].before);
    expect_same_bits(told->made_cuts()[i].after, live->made_cuts()[i].after);
  }
  for (std::size_t n = 0; n < 16; ++n) EXPECT_EQ(told->steps()[n].has_cut, live->steps()[n].has_cut) << n;
}

TEST_P(CutNow, RefusedFailedOrBesideLeavesEveryBit) {
  class Fails : public CuttingMethod {
    void improve(Sheet&, MethodNotes&) override { throw CutFailed(Verdict::not_terminated, "made to fail"); }
  } fails;
  const Scene scene = falling(GetParam());
  const auto method = method_of(GetParam());
  const auto tried = start(scene), left_alone = start(scene);
  for (int round = 0; round < 2; ++round) {
    step(*tried, 5);
    step(*left_alone, 5);
    EXPECT_EQ(tried->cut_now({&far_too_long, 1}, *method).cut.status, Status::refused);
    EXPECT_EQ(tried->cut_now({&beside, 1}, *method).cut.status, Status::noop);
    const MotionCut failed = tried->cut_now({&second, 1}, fails);
    EXPECT_EQ(failed.cut.status, Status::failed);
    EXPECT_NE(failed.verdict, Verdict::ok);
    expect_same_bits(*tried, *left_alone);
    if (round > 0) break;
    for (const auto& motion : {tried.get(), left_alone.get()})
      EXPECT_EQ(motion->cut_now({&slit, 1}, *method).cut.status, Status::ok);
  }
  step(*tried, 5);
  step(*left_alone, 5);
  expect_same_bits(*tried, *left_alone);
  EXPECT_EQ(tried->outcome().verdict, Verdict::ok);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, CutNow,
    testing::Values(Kind{"conventional_split", 0, 3, BendingKind::patches, Integrator::backward_euler, "multigrid"},
                    Kind{"warp_and_refine", 0.4, 3, BendingKind::hinges, Integrator::midpoint, "cg"},
                    Kind{"conventional_split", 0, 2, BendingKind::none, Integrator::xpbd, "cg"},
                    Kind{"edge_release", 0, 2, BendingKind::none, Integrator::symplectic_euler, "cg"},
                    Kind{"cut_polygons", 0, 3, BendingKind::patches, Integrator::backward_euler, "cg"},
                    Kind{"split_and_tie", 0.1, 3, BendingKind::none, Integrator::backward_euler, "cholmod"},
                    Kind{"phantom_node", 0, 3, BendingKind::patches, Integrator::backward_euler, "cholmod"},
                    Kind{"phantom_node", 0, 3, BendingKind::hinges, Integrator::midpoint, "multigrid"},
                    Kind{"phantom_node:consistent_mass", 0, 2, BendingKind::none, Integrator::backward_euler,
                         "cholmod"}));

constexpr Kind plain{"conventional_split", 0, 3, BendingKind::none, Integrator::backward_euler, "cg"};

TEST(CutNowOf, SeveralCurvesIsASceneCutOfThem) {
  Scene scene = falling(plain);
  const auto live = start(scene);
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.time = 3.5 * scene.step;
  cut.family = "several";
  cut.seed = 3;
  const std::vector<Curve> curves = make_case("several", 3, 0, live->sheet());
  ASSERT_EQ(curves.size(), 4u);
  const auto told = start(scene);
  const auto method = method_of(plain);
  told->advance(8 * scene.step, *method, {});
  step(*live, 3);
  EXPECT_EQ(live->cut_now(curves, *method).cut.status, Status::ok);
  step(*live, 5);
  expect_same_bits(*told, *live);
}

/// The scene's own cuts are made when they are due, whatever was cut before.
TEST(CutNowOf, ASceneWithCutsOfItsOwnAndABlade) {
  Scene scene = falling(plain);
  add_cut(scene, 6.5, second);
  scene.cuts.back().speed = 60;
  const auto live = start(scene);
  scene.cuts.clear();
  add_cut(scene, 2.5, slit);
  add_cut(scene, 6.5, second);
  scene.cuts.back().speed = 60;
  const auto told = start(scene);
  const auto method = method_of(plain);
  told->advance(16 * scene.step, *method, {});
  step(*live, 2);
  live->cut_now({&slit, 1}, *method);
  live->advance(16 * scene.step, *method, {});
  ASSERT_EQ(live->made_cuts().size(), 2u);
  EXPECT_GT(live->made_cuts()[1].parts, 1u);
  expect_same_bits(*told, *live);
}

TEST(CutNowOf, WhatNoSceneTakesIsRefusedBeforehand) {
  Scene scene = falling(plain);
  const auto method = method_of(plain);
  const auto motion = Simulation::start(scene);
  expect_refused([&] { motion->cut_now({}, *method); }, "no curve");
  const Curve point{Curve::Kind::polyline, false, {{0.5, 0.5}}};
  expect_refused([&] { motion->cut_now({&point, 1}, *method); }, "at least 2 points");
  EXPECT_TRUE(motion->made_cuts().empty());
  scene.active_radius = 0.4;
  add_cut(scene, 3.5, slit);
  const auto local = Simulation::start(scene);
  expect_refused([&] { local->cut_now({&slit, 1}, *method); }, "an active radius needs to know all cuts");
}

/// What a method constrains may not go with the scene: said, and nothing is cut.
TEST(CutNowOf, AMethodThatDoesNotSuitTheScene) {
  Scene scene = falling(plain);
  scene.integrator = Integrator::xpbd;
  const auto motion = Simulation::start(scene);
  const auto method = find_method("split_and_tie").make(0.1);
  const std::size_t triangles = motion->sheet().triangle_count();
  const MotionCut cut = motion->cut_now({&slit, 1}, *method);
  EXPECT_EQ(cut.cut.status, Status::refused);
  EXPECT_NE(cut.reason.find("xpbd"), std::string::npos) << cut.reason;
  EXPECT_EQ(motion->sheet().triangle_count(), triangles);
}

}  // namespace
}  // namespace cutbench
