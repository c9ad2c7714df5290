// New vertices of a bent sheet go where bending wants them: a cut makes no energy, and moves nothing that was there.
#include "harness/fem/model/settle.h"

#include <gtest/gtest.h>

#include "harness/cut/constraint_source.h"
#include "harness/simulation/simulation.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

constexpr Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

/// Round a cylinder of half a turn, and stretched.
Body<3> rolled() {
  MeshData mesh = make_sheet("delaunay", 12);
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    const auto [a, b] = mesh.rest[v];
    mesh.deformed[v] = {0.33 * std::sin(3 * a), 1.01 * b, 0.33 * std::cos(3 * a)};
  }
  return {mesh, skin, {.bending = BendingKind::patches}, {{.where = {{0, 0}, {0, 1}}}}};
}

double elastic(Body<3>& body) {
  const Energy energy = balance_of(body.model, body.state).energy;
  return energy.membrane + energy.bending;
}

struct Jumps {
  double as_transferred = 0, settled = 0;
};

/// Straight cuts from anywhere to anywhere, each in a sheet of its own.
Jumps jumps(const char* method) {
  Jumps sum;
  for (const auto& [from, to] : {std::pair<Point2, Point2>{{0.31, 0.2}, {0.48, 0.83}},
                                 {{0.2, 0.43}, {0.83, 0.51}},
                                 {{0.7, 0.21}, {0.21, 0.77}},
                                 {{0.52, 0.13}, {0.54, 0.9}}}) {
    Body<3> body = rolled();
    const double before = elastic(body);
    EXPECT_EQ(body.cut(line(from, to), method, find_method(method).parameter.value), Status::ok);
    sum.as_transferred += elastic(body) - before;
    settle_new_vertices(body.model, body.sheet, body.state.x);
    sum.settled += elastic(body) - before;
  }
  return sum;
}

TEST(Settle, ACutMakesHardlyAnyEnergy) {
  for (const char* method : {"conventional_split", "snap_or_split", "warp_and_refine"}) {
    const Jumps jump = jumps(method);
    EXPECT_GT(jump.as_transferred, 0) << method;
    EXPECT_LT(jump.settled, 0.25 * jump.as_transferred) << method;
  }
}

TEST(Settle, OnlyNewVerticesMoveAndLipsStayClosed) {
  Body<3> body = rolled();
  const Field before = body.state.x;
  ASSERT_EQ(body.cut(line({0.31, 0.2}, {0.48, 0.83})), Status::ok);
  const Field transferred = body.state.x;
  settle_new_vertices(body.model, body.sheet, body.state.x);
  EXPECT_EQ(body.state.x.head(before.size()), before);
  EXPECT_NE(body.state.x, transferred);
  std::map<VertexIndex, Eigen::Vector3d> place;
  std::size_t lips = 0;
  for (const DeformedIndex d : body.sheet.log().new_deformed) {
    const Eigen::Vector3d x = body.state.x.segment<3>(3 * d.value);
    const auto [other, is_first] = place.try_emplace(body.sheet.rest_vertex(d), x);
    EXPECT_EQ(other->second, x);
    lips += !is_first;
  }
  EXPECT_GT(lips, 5u);
}

/// Where the sheet only carries its own weight nothing is to be settled: no bit changes.
TEST(Settle, AFlatSheetStays) {
  Body<3> body(make_sheet("delaunay", 8), skin, {.bending = BendingKind::patches});
  ASSERT_EQ(body.cut(line({0.31, 0.2}, {0.48, 0.83})), Status::ok);
  const Field transferred = body.state.x;
  settle_new_vertices(body.model, body.sheet, body.state.x);
  EXPECT_LT((body.state.x - transferred).cwiseAbs().maxCoeff(), 1e-14);
}

/// Vertices inside its polygons are none that could move.
TEST(Settle, NewCornersOfPolygonsDoToo) {
  Body<3> body = rolled();
  const Sheet uncut = body.sheet;
  const double thinness = find_method("cut_polygons").parameter.value;
  const auto method = find_method("cut_polygons").make(thinness);
  Jumps jump;
  for (const auto& [from, to] : {std::pair<Point2, Point2>{{0.21, 0.2}, {0.28, 0.83}},
                                 {{0.41, 0.2}, {0.48, 0.83}},
                                 {{0.2, 0.33}, {0.83, 0.31}},
                                 {{0.2, 0.63}, {0.83, 0.61}}}) {
    const double before = elastic(body);
    ASSERT_EQ(body.cut(line(from, to), "cut_polygons", thinness), Status::ok);
    body.model.constrain(body.sheet, method->constraint_source()->next_constraints(
                                         uncut, body.sheet, {}, body.model.elements().left_since_change()));
    body.model.follow(body.state.x);
    jump.as_transferred += elastic(body) - before;
    settle_new_vertices(body.model, body.sheet, body.state.x);
    body.model.follow(body.state.x);
    jump.settled += elastic(body) - before;
  }
  EXPECT_GT(jump.as_transferred, 0);
  EXPECT_LT(jump.settled, 0.25 * jump.as_transferred);
}

/// In a scene the robust step asks for it, another one does not.
TEST(Settle, ByRobustStepsAlone) {
  for (const char* method : {"conventional_split", "cut_polygons"}) {
    std::vector<double> jumps;
    for (const bool robust : {false, true}) {
      Scene scene;
      scene.mesh = MeshData(make_sheet("delaunay", 12));
      scene.family = "delaunay";
      for (std::size_t v = 0; v < scene.mesh->rest.size(); ++v) {
        const auto [a, b] = scene.mesh->rest[v];
        scene.mesh->deformed[v] = {0.33 * std::sin(3 * a), b, 0.33 * std::cos(3 * a)};
      }
      scene.material = skin;
      scene.physics.bending = BendingKind::patches;
      scene.step = 1e-3;
      scene.duration = 1;
      scene.robust = robust;
      const auto motion = Simulation::start(scene);
      const auto tool = find_method(method).make(find_method(method).parameter.value);
      const Curve curve = line({0.31, 0.2}, {0.48, 0.83});
      const MotionCut cut = motion->cut_now({&curve, 1}, *tool);
      jumps.push_back(cut.after.energy.bending - cut.before.energy.bending);
    }
    EXPECT_LT(jumps[1], 0.5 * jumps[0]) << method;
  }
}

}  // namespace
}  // namespace cutbench
