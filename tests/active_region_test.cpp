// Local dynamics: what is far from the cuts stays where it is, and what is near moves as in the whole sheet.

#include "harness/simulation/active_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/mesh/families.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

Scene::Cut cut_at(double time, std::vector<Point2> points) {
  Scene::Cut cut;
  cut.time = time;
  cut.curve.points = std::move(points);
  return cut;
}

/// Hangs by two corners and swings, and is slit when it has fallen.
Scene hanging(double radius) {
  Scene scene;
  scene.family = "delaunay";
  scene.resolution = 800;
  scene.material = {.density = 2.2,
                    .stiffness = 1000,
                    .poisson = 0.45,
                    .bending = 4.2e-4,
                    .mass_damping = 0.5,
                    .stiffness_damping = 1e-3};
  scene.physics.bending = BendingKind::patches;
  scene.physics.gravity = {0, 0, -9.81};
  scene.active_radius = radius;
  for (const Point2 corner : {Point2{0, 1}, Point2{1, 1}}) scene.pins.push_back({.near = corner, .pin = {}});
  scene.step = 1.0 / 240;
  scene.duration = 0.3;
  scene.cuts.push_back(cut_at(0.1, {{0.35, 0.42}, {0.65, 0.47}}));
  return scene;
}

/// In the plane, drawn apart by what holds it below and above.
Scene drawn(double radius) {
  Scene scene;
  scene.family = "delaunay";
  scene.resolution = 800;
  scene.material = {.density = 1, .stiffness = 1000, .poisson = 0.3, .mass_damping = 20};
  scene.physics.dimension = 2;
  scene.active_radius = radius;
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {infinite, 0}}}});
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, 1}, {infinite, infinite}}, .velocity = {0, 0.1, 0}}});
  scene.step = 1.0 / 120;
  scene.duration = 1;
  scene.solver = {.name = "cholmod"};
  scene.cuts.push_back(cut_at(0.9, {{0.4, 0.5}, {0.6, 0.52}}));
  return scene;
}

struct Made {
  std::unique_ptr<Simulation> motion;
  Sheet at_cut;  ///< right before it
};

Made run(const Scene& scene) {
  const auto method = find_method("conventional_split").make(0);
  auto motion = Simulation::start(scene);
  motion->watch();
  EXPECT_EQ(motion->advance(scene.cuts[0].time, *method, {}).verdict, Verdict::ok);
  Sheet at_cut = motion->posed_sheet();
  EXPECT_EQ(motion->advance(scene.duration, *method, {}).verdict, Verdict::ok);
  EXPECT_EQ(motion->outcome().verdict, Verdict::ok) << motion->outcome().reason;
  EXPECT_EQ(motion->made_cuts().size(), 1u);
  return {std::move(motion), std::move(at_cut)};
}

/// By rest position, those of both lips.
std::map<std::pair<double, double>, std::vector<Point3>> places_of(const Sheet& sheet) {
  std::map<std::pair<double, double>, std::vector<Point3>> places;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid())
      places[{sheet.rest(v).x, sheet.rest(v).y}].push_back(sheet.position(DeformedIndex(d)));
  return places;
}

double apart(Point3 a, Point3 b) {
  const Point3 d = a + -1 * b;
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

double largest_gape(const Sheet& sheet) {
  double largest = 0;
  for (const auto& [rest, copies] : places_of(sheet))
    for (const Point3 a : copies)
      for (const Point3 b : copies) largest = std::max(largest, apart(a, b));
  return largest;
}

double distance_to_cut(Point2 p, const Scene& scene) {
  const Point2 a = scene.cuts[0].curve.points[0], ab = scene.cuts[0].curve.points[1] - a;
  const double t = std::min(1.0, std::max(0.0, dot(p - a, ab) / squared_length(ab)));
  return std::sqrt(squared_length(p - (a + t * ab)));
}

TEST(ActiveRegion, NothingIsOutsideOfALargeRadius) {
  const Sheet sheet(make_sheet("graded", 10));
  const std::vector<Curve> curve{{Curve::Kind::polyline, false, {{0.2, 0.5}, {0.8, 0.5}}}};
  EXPECT_TRUE(active_region(sheet, curve, 10).outside.empty());
  EXPECT_TRUE(active_region(sheet, curve, 10).pins.empty());
  const std::vector<Curve> beside{{Curve::Kind::polyline, false, {{3, 3}, {4, 4}}}};
  EXPECT_TRUE(active_region(sheet, beside, 0.5).outside.empty()) << "a cut that misses the sheet";
}

/// Squares of a tenth: near are the middle 3 x 3 vertices, held the two rings round them.
TEST(ActiveRegion, TwoRingsAreHeld) {
  const Sheet sheet(make_sheet("alternating", 10));
  const std::vector<Curve> point{{Curve::Kind::polyline, false, {{0.49, 0.5}, {0.51, 0.5}}}};
  const ActiveRegion region = active_region(sheet, point, 0.15);
  EXPECT_FALSE(region.outside.empty());
  for (const Pin& pin : region.pins) {
    const double far = std::max(std::abs(pin.where.low.x - 0.5), std::abs(pin.where.low.y - 0.5));
    EXPECT_GT(far, 0.15);
    EXPECT_LT(far, 0.35);
  }
  EXPECT_GE(region.pins.size(), 16u);
  EXPECT_LE(region.pins.size(), 40u);
}

TEST(ActiveRegion, WhatAClosedCurveHoldsMoves) {
  const Sheet sheet(make_sheet("grid", 20));
  const std::vector<Curve> square{{Curve::Kind::polyline, true, {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.8}}}};
  const ActiveRegion region = active_region(sheet, square, 0.06);
  EXPECT_FALSE(region.outside.empty());
  for (const TriangleIndex t : region.outside)
    for (const VertexIndex v : sheet.triangle(t).vertex) {
      const Point2 p = sheet.rest(v);
      EXPECT_FALSE(p.x > 0.2 && p.x < 0.8 && p.y > 0.2 && p.y < 0.8);
    }
}

/// A U: what hangs at its open end is cut out but for that, and moves.
TEST(ActiveRegion, WhatAFlapIsMadeOfMoves) {
  const Sheet sheet(make_sheet("grid", 20));
  const std::vector<Curve> flap{{Curve::Kind::polyline, false, {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.8}}}};
  const ActiveRegion region = active_region(sheet, flap, 0.06);
  EXPECT_FALSE(region.outside.empty());
  for (const Pin& pin : region.pins) {
    const Point2 p = pin.where.low;
    EXPECT_FALSE(p.x > 0.2 && p.x < 0.8 && p.y > 0.2 && p.y < 0.8) << p.x << " " << p.y;
  }
}

TEST(ActiveRegion, ASmallerRadiusThanAnEdgeIsRefused) {
  expect_refused([] { Simulation::start(hanging(0.01)); }, "\"active_radius\" 0.01 m is less than the longest edge");
}

/// The slots of vertices that were held come into use again.
TEST(ActiveRegion, WhatACutMakesInPlaceOfAHeldVertexIsFree) {
  Sheet sheet(make_sheet("grid", 10));
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) sheet.hold(VertexIndex(v));
  std::vector<TriangleIndex> lower;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (std::ranges::all_of(sheet.corners(TriangleIndex(t)), [](Point2 p) { return p.y < 0.45; }))
      lower.push_back(TriangleIndex(t));
  sheet.begin_cut();
  sheet.remove(lower);
  const std::size_t slots = sheet.vertex_slots();
  Locator locator(sheet);
  const auto method = find_method("conventional_split").make(0);
  ASSERT_EQ(
      Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.23, 0.71}, {0.77, 0.74}}}, *method, {}).status,
      Status::ok);
  std::size_t recycled = 0;
  for (const VertexIndex v : sheet.log().new_vertices) {
    recycled += v() < slots;
    EXPECT_FALSE(sheet.is_held(v));
  }
  EXPECT_GT(recycled, 5u);
}

struct Kind {
  const char *sheet, *method;
  int dimension;
  BendingKind bending;
  Integrator integrator;
  Mass mass;
  const char* solver;
  double speed;  ///< of the second cut, a blade; 0: all at once
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.method << ", " << name_of(integrator_names, kind.integrator);
}

class LocalDynamicsOf : public testing::TestWithParam<Kind> {};

/// What is left out and what is held are alike: the same motion as of the whole sheet with a pin at each vertex that is
/// far. Hinges, not patches: these look farther than two rings.
TEST_P(LocalDynamicsOf, IsTheWholeSheetHeldFarAway) {
  constexpr double radius = 0.22;
  const Kind kind = GetParam();
  Scene local;
  local.family = kind.sheet;
  local.resolution = 800;
  local.material = {.density = 2.2,
                    .stiffness = 100,
                    .poisson = 0.3,
                    .bending = 1e-3,
                    .mass_damping = 0.5,
                    .stiffness_damping = 1e-3};
  local.physics.dimension = kind.dimension;
  local.physics.bending = kind.bending;
  local.physics.mass = kind.mass;
  local.physics.gravity = {1, 3, kind.dimension == 3 ? -9.81 : 0};
  local.active_radius = radius;
  local.integrator = kind.integrator;
  local.solver = {.name = kind.solver, .tolerance = 1e-11};
  local.step = kind.integrator == Integrator::symplectic_euler ? 2e-4 : 1.0 / 240;
  local.duration = 0.05;
  local.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {0, infinite}}}});
  local.cuts.push_back(cut_at(0, {{0.42, 0.47}, {0.58, 0.52}}));
  local.cuts.push_back(cut_at(0.01, {{0.45, 0.58}, {0.56, 0.61}}));
  local.cuts[1].speed = kind.speed;

  Scene held = local;
  held.active_radius = infinite;
  const Sheet sheet(mesh_of(held));
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) {
    const Point2 p = sheet.rest(VertexIndex(v));
    double nearest = infinite;
    for (const auto& cut : local.cuts)
      for (int i = 0; i <= 1000; ++i)
        nearest =
            std::min(nearest, std::sqrt(squared_length(p - cut.curve.points[0] -
                                                       i / 1000.0 * (cut.curve.points[1] - cut.curve.points[0]))));
    if (nearest > radius) held.pins.push_back({.near = p, .pin = {}});
  }

  const auto end_of = [&](const Scene& scene) {
    const auto method = find_method(kind.method).make(find_method(kind.method).parameter.value);
    const auto motion = Simulation::start(scene);
    EXPECT_EQ(motion->advance(scene.duration, *method, {}).verdict, Verdict::ok);
    EXPECT_EQ(motion->made_cuts().size(), 2u);
    for (const MotionCut& cut : motion->made_cuts()) EXPECT_EQ(cut.cut.status, Status::ok) << cut.reason;
    return motion->posed_sheet();
  };
  const Sheet here = end_of(local), there = end_of(held);
  EXPECT_LT(here.triangle_slots(), 0.7 * to_double(there.triangle_slots()));
  const auto expected = places_of(there);
  double moved = 0;
  for (const auto& [rest, copies] : places_of(here)) {
    const auto at = expected.find(rest);
    ASSERT_NE(at, expected.end()) << rest.first << " " << rest.second;
    for (const Point3 copy : copies) {
      double nearest = infinite;
      for (const Point3 p : at->second) nearest = std::min(nearest, apart(p, copy));
      EXPECT_LT(nearest, 1e-9) << rest.first << " " << rest.second;
      moved = std::max(moved, apart(copy, {rest.first, rest.second, 0}));
    }
  }
  EXPECT_GT(moved, 1e-3);
}

constexpr auto implicit = Integrator::backward_euler;
INSTANTIATE_TEST_SUITE_P(
    Kinds, LocalDynamicsOf,
    testing::Values(
        Kind{"delaunay", "conventional_split", 3, BendingKind::hinges, implicit, Mass::lumped, "cholmod", 0},
        Kind{"graded", "conventional_split", 3, BendingKind::hinges, implicit, Mass::lumped, "multigrid", 2},
        Kind{"delaunay", "warp_and_refine", 3, BendingKind::hinges, implicit, Mass::consistent, "cholmod", 0},
        Kind{"delaunay", "cut_polygons", 2, BendingKind::none, implicit, Mass::lumped, "cholmod", 0},
        Kind{"delaunay", "split_and_tie", 2, BendingKind::none, implicit, Mass::lumped, "cholmod", 0},
        Kind{"grid", "conventional_split", 3, BendingKind::hinges, Integrator::symplectic_euler, Mass::stabilised,
             "cholmod", 0},
        Kind{"grid", "snap_or_split", 2, BendingKind::none, Integrator::midpoint, Mass::lumped, "cg", 0}));

TEST(LocalDynamics, OnlyWhatIsNearMoves) {
  const Scene scene = hanging(0.2);
  const Made made = run(scene);
  const Sheet end = made.motion->posed_sheet();
  const auto before = places_of(made.at_cut), after = places_of(end);
  EXPECT_LT(after.size(), before.size());
  double moved = 0;
  for (const auto& [rest, copies] : after) {
    const auto was = before.find(rest);
    if (was == before.end()) continue;  // made by the cut
    const bool is_near = distance_to_cut({rest.first, rest.second}, scene) <= 0.2;
    for (const Point3 copy : copies) {
      const double by = apart(copy, was->second.front());
      if (is_near) moved = std::max(moved, by);
      EXPECT_TRUE(by < 1e-12 || is_near) << by;
    }
  }
  EXPECT_GT(moved, 1e-3);
}

/// What is held goes on as it is told, and the lips gape the more like those of the whole sheet the larger the radius.
TEST(LocalDynamics, ALargerRadiusIsCloserToTheWholeSheet) {
  const double whole = largest_gape(run(drawn(infinite)).motion->posed_sheet());
  const double small = largest_gape(run(drawn(0.12)).motion->posed_sheet());
  const double large = largest_gape(run(drawn(0.3)).motion->posed_sheet());
  EXPECT_GT(whole, 0.01);
  EXPECT_LT(std::abs(large - whole), 0.5 * std::abs(small - whole));
  EXPECT_LT(std::abs(large - whole), 0.2 * whole);
  const Sheet end = run(drawn(0.47)).motion->posed_sheet();
  double highest = 0;
  for (const auto& [rest, copies] : places_of(end)) {
    if (rest.second < 1) continue;
    highest = std::max(highest, copies.front().y);
    EXPECT_NEAR(copies.front().y, 1.1, 1e-9) << "the border goes on";
  }
  EXPECT_GT(highest, 1);
}

}  // namespace
}  // namespace cutbench
