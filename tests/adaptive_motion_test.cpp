// adaptive_remesh in a moving sheet: it sees the sheet as it is when it is cut, not as it was made.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/cut/motion.h"
#include "harness/mesh/families.h"
#include "harness/simulation/simulation.h"
#include "methods/adaptive_remesh/adaptive_remesh.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

using Place = std::function<Point3(Point2)>;

const Curve slanted{Curve::Kind::polyline, false, {{0.21, 0.52}, {0.79, 0.47}}};

Point3 flat(Point2 p) { return {p.x, p.y, 0}; }
Point3 still(Point2) { return {}; }
Point3 rolled(Point2 p) { return {0.11 * std::sin(10 * p.x), p.y, 0.11 * std::cos(10 * p.x)}; }

std::vector<double> field_of(const Sheet& sheet, const Place& place, int dimension) {
  std::vector<double> field;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const Point3 p = place(sheet.rest(sheet.rest_vertex(DeformedIndex(d))));
    for (const double x : {p.x, p.y, p.z})
      if (to_int(field.size()) < dimension * to_int(d + 1)) field.push_back(x);
  }
  return field;
}

/// A sheet that was made flat, and is somewhere else now.
struct Moving {
  Moving(const std::string& family, const Place& place, const Place& speed, int dim = 3)
      : sheet(make_sheet(family, 20)), x(field_of(sheet, place, dim)), v(field_of(sheet, speed, dim)), dimension(dim) {}

  Motion motion() const { return {.x = x, .v = v, .dimension = dimension, .poisson = 0.3}; }

  MeshData cut(const std::string& name, double parameter, bool seen = true) {
    const auto method = find_method(name).make(parameter);
    Locator locator(sheet);
    const Motion now = motion();
    if (seen) method->see(&now);
    EXPECT_EQ(Cutter().cut(sheet, locator, slanted, *method, {}).status, Status::ok);
    return sheet.to_mesh_data();
  }
  std::size_t vertices_after(const std::string& name, double parameter) { return cut(name, parameter).rest.size(); }

  Sheet sheet;
  std::vector<double> x, v;
  int dimension;
};

/// What a sheet made there gets, to the last bit.
TEST(AdaptiveMotion, CutsTheSheetAsItIsNow) {
  for (const std::string family : sheet_families()) {
    Moving moving(family, rolled, still), made_flat(family, flat, still), made_so(family, rolled, still);
    for (std::size_t d = 0; d < made_so.sheet.deformed_slots(); ++d) {
      const DeformedIndex at(d);
      made_so.sheet.set_position(at, rolled(made_so.sheet.rest(made_so.sheet.rest_vertex(at))));
    }
    const MeshData now = moving.cut("adaptive_remesh", 0.2);
    const MeshData expected = made_so.cut("adaptive_remesh", 0.2, false);
    EXPECT_EQ(now.rest, expected.rest) << family;
    EXPECT_EQ(now.triangles, expected.triangles) << family;
    EXPECT_GT(now.rest.size(), made_flat.cut("adaptive_remesh", 0.2, false).rest.size()) << family;
  }
}

/// An affine motion is what interpolation gives at vertices that the cut made or moved.
TEST(AdaptiveMotion, InterpolatesPlacesAndVelocities) {
  const Place place = [](Point2 p) { return Point3{1.1 * p.x - 0.2 * p.y, 0.3 + p.y, 0.5 * p.x}; };
  const Place speed = [](Point2 p) { return Point3{p.y, -2 * p.x + 1, 3}; };
  for (const std::string method : {"adaptive_remesh", "warp_and_refine", "conventional_split"}) {
    Moving moving("delaunay", place, speed);
    const std::size_t before = moving.sheet.deformed_slots();
    const Motion motion = moving.motion();
    DeformedState state;
    state.see(&motion);
    moving.cut(method, find_method(method).parameter.value);
    state.begin(moving.sheet);
    EXPECT_GT(moving.sheet.deformed_slots(), before);
    for (std::size_t t = 0; t < moving.sheet.triangle_slots(); ++t) {
      const Triangle& triangle = moving.sheet.triangle(TriangleIndex(t));
      if (!triangle.alive()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point2 p = moving.sheet.rest(triangle.vertex[k]);
        const Point3 x = state.position(moving.sheet, triangle.deformed[k]), v = state.velocity(triangle.deformed[k]);
        const Point3 is = place(p), goes = speed(p);
        for (const auto& [a, b] : {std::pair(x.x, is.x), {x.y, is.y}, {x.z, is.z}, {v.x, goes.x}, {v.y, goes.y}})
          ASSERT_NEAR(a, b, 1e-12) << method;
      }
    }
  }
}

double metric_of(const Moving& moving, const DeformedTerms& terms, double h = 1, double h_tip = 1) {
  const Motion motion = moving.motion();
  DeformedState state;
  state.see(&motion);
  state.begin(moving.sheet);
  const double metric = deformed_metric(moving.sheet, state, TriangleIndex(7), terms, h, h_tip);
  for (std::size_t t = 0; t < moving.sheet.triangle_slots(); ++t)
    EXPECT_NEAR(deformed_metric(moving.sheet, state, TriangleIndex(t), terms, h, h_tip), metric, 1e-9 * (metric + 1));
  return metric;
}

/// The ends of an edge of the asked length differ by the velocity of the term: here that is 0.5 / 4 m.
TEST(AdaptiveMotion, VelocityAsksForEdgesWhoseEndsDifferByIt) {
  constexpr DeformedTerms velocity{.angle = 0, .compression = 0, .velocity = 0.5, .stress = 0};
  const Place shear = [](Point2 p) { return Point3{0, 0, 4 * p.y}; };
  EXPECT_NEAR(metric_of({"delaunay", flat, shear}, velocity), 64, 1e-9);
  const Place in_plane = [](Point2 p) { return Point3{3 * p.x, 0, 0}; };
  EXPECT_NEAR(metric_of({"graded", flat, in_plane, 2}, velocity), 36, 1e-9);
  EXPECT_EQ(metric_of({"delaunay", rolled, still}, velocity), 0);
}

/// Pulled by 2 % along x, with its sides held: E / (1 - nu^2) times (1.02^2 - 1) / 2.
TEST(AdaptiveMotion, StressAsksForTipsFromAQuarterOfItOn) {
  const Place pulled = [](Point2 p) { return Point3{1.02 * p.x, p.y, 0}; };
  constexpr double stress = 0.0202 / 0.91, h_tip = 0.1;
  const auto share = [&](double of) {
    const DeformedTerms terms{.angle = 0, .compression = 0, .velocity = 0, .stress = stress / of};
    return metric_of({"delaunay", pulled, still}, terms, 1, h_tip) * h_tip * h_tip;
  };
  EXPECT_EQ(share(0.2), 0);
  EXPECT_NEAR(share(0.25), 0, 1e-9);
  EXPECT_NEAR(share(0.625), 0.5, 1e-9);
  EXPECT_NEAR(share(1), 1, 1e-9);
  EXPECT_EQ(share(3), 1);
}

TEST(AdaptiveMotion, IsFineWhereVelocityOrStressChange) {
  const Place waving = [](Point2 p) { return Point3{0, 0, 20 * p.x}; };
  const Place pulled = [](Point2 p) { return Point3{1.1 * p.x, p.y, 0}; };
  const std::size_t at_rest = Moving("grid", flat, still).vertices_after("adaptive_remesh", 0.2);
  EXPECT_GT(Moving("grid", flat, waving).vertices_after("adaptive_remesh", 0.2), at_rest + 100);
  EXPECT_EQ(Moving("grid", flat, waving).vertices_after("adaptive_remesh:velocity", 0), at_rest);
  EXPECT_EQ(Moving("grid", pulled, still).vertices_after("adaptive_remesh", 0.2), at_rest);
  EXPECT_GT(Moving("grid", pulled, still).vertices_after("adaptive_remesh:stress", 0.05), at_rest + 100);
}

/// The limit of vertices was met, and then a round changed nothing, as if all were done.
TEST(AdaptiveMotion, SaysThatItMetTheLimitOfVertices) {
  const Place wild = [](Point2 p) { return Point3{0, 0, 1000 * p.x}; };
  Moving moving("grid", flat, wild);
  const auto method = find_method("adaptive_remesh").make(0.1);
  Locator locator(moving.sheet);
  const Motion now = moving.motion();
  method->see(&now);
  const CutOutcome outcome = Cutter().cut(moving.sheet, locator, slanted, *method, {});
  EXPECT_EQ(outcome.status, Status::ok);
  EXPECT_GT(moving.sheet.log().new_vertices.size(), 1000U);
  EXPECT_NE(outcome.reason, "");
}

/// Keeps what it was shown, and cuts as the default does.
class Watcher : public CuttingMethod {
 public:
  void see(const Motion* motion) override {
    looks = motion != nullptr;
    if (!motion) return;
    x.assign(motion->x.begin(), motion->x.end());
    v.assign(motion->v.begin(), motion->v.end());
  }
  std::vector<double> x, v;
  bool looks = false;
};

TEST(AdaptiveMotion, ASceneShowsItsMotionBeforeACut) {
  Scene scene;
  scene.resolution = 200;
  scene.physics.dimension = 3;
  scene.physics.gravity = {0, 0, -9.81};
  scene.pins.push_back({.near = {}, .pin = {.where = {{-infinite, -infinite}, {0, infinite}}}});
  const auto motion = Simulation::start(scene);
  Watcher watcher;
  for (int i = 0; i < 20; ++i) ASSERT_EQ(motion->step().verdict, Verdict::ok);
  const Sheet posed = motion->posed_sheet();
  ASSERT_EQ(motion->cut_now({&slanted, 1}, watcher, {}).verdict, Verdict::ok);
  EXPECT_FALSE(watcher.looks);
  double fastest = 0;
  for (std::size_t d = 0; d < posed.deformed_slots(); ++d) {
    const Point3 p = posed.position(DeformedIndex(d));
    EXPECT_EQ((std::array{watcher.x[3 * d], watcher.x[3 * d + 1], watcher.x[3 * d + 2]}), (std::array{p.x, p.y, p.z}));
    fastest = std::max(fastest, std::abs(watcher.v[3 * d + 2]));
  }
  EXPECT_GT(fastest, 0.1);
}

}  // namespace
}  // namespace cutbench
