// No gap opens along a seam, whatever vertices a method adds on either side; and a file keeps it so.
#include <gtest/gtest.h>

#include "harness/mesh/mesh_text.h"
#include "harness/mesh/seams.h"
#include "harness/path/pick.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

/// Where `edge` is in space at `place` along its seam.
Point3 at_place(const Sheet& sheet, const SewnEdge& edge, double place) {
  const auto& vertices = sheet.triangle(triangle_of(edge.edge)).deformed;
  const int k = corner_of(edge.edge);
  const Point3 from = sheet.position(vertices[to_size(k)]), to = sheet.position(vertices[to_size(next_corner(k))]);
  const double share = (place - edge.begin) / (edge.end - edge.begin);
  return (1 - share) * from + share * to;
}

struct Gap {
  double largest = 0;     ///< m
  std::size_t alone = 0;  ///< vertices that one side has within an edge of the other
};

/// Between the two sides of all seams, looked at where either side has a vertex.
Gap gap_along_seams(const Sheet& sheet) {
  const std::vector<SewnEdge> edges = sewn_edges(sheet);
  Gap gap;
  for (const SewnEdge& a : edges)
    for (const SewnEdge& b : edges) {
      const double low = std::max(a.low(), b.low()), high = std::min(a.high(), b.high());
      if (a.seam != b.seam || a.first == b.first || high - low < 1e-6) continue;
      for (const double place : {low, high})
        gap.largest = std::max(gap.largest, length(at_place(sheet, a, place) + -1.0 * at_place(sheet, b, place)));
      gap.alone += low > a.low() + 1e-6;
    }
  return gap;
}

/// Of a sheet of four panels, held at x = 0, that hangs and is cut over its seams at once.
Sheet cut_while_it_hangs(const char* method) {
  Scene scene;
  scene.mesh = in_panels(make_sheet("delaunay", 12), in_quarters);
  scene.material = {.density = 0.3, .stiffness = 200};
  scene.physics.gravity = {0, 0, -9.81};
  scene.solver.name = "constant_factor";
  scene.pins.emplace_back().in_space = {{{-1e9, -1e9, -1e9}, {0, 1e9, 1e9}}};
  PickedCurve path{Curve::Kind::polyline, false, {}};
  for (const Point3 p : {Point3{0.31, 0.12, 0}, Point3{0.62, 0.33, 0}, Point3{0.71, 0.74, 0}})
    path.picks.push_back({p, {}});
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.time = 0;
  cut.picked = path;
  const auto motion = Simulation::start(scene);
  const auto cutter = find_method(method).make(find_method(method).parameter.value);
  const StepReport report = motion->advance(0.25, *cutter, {});
  EXPECT_EQ(report.verdict, Verdict::ok) << method << ": " << report.reason;
  return motion->posed_sheet();
}

const std::array methods{"longest_edge", "conventional_split", "bowyer_watson", "delaunay_refine", "adaptive_remesh"};

TEST(SeamTies, NoGapOpensWhereOneSideIsRefined) {
  std::size_t alone = 0;
  for (const char* method : methods) {
    const Gap gap = gap_along_seams(cut_while_it_hangs(method));
    EXPECT_LT(gap.largest, 1e-9) << method;
    alone += gap.alone;
  }
  EXPECT_GT(alone, 15u);
}

TEST(SeamTies, AFileKeepsASeamWhereOneSideIsRefined) {
  std::size_t alone = 0;
  for (const char* method : methods) {
    const Sheet sheet = cut_while_it_hangs(method);
    MeshData again = read_obj(obj_text(sheet.to_mesh_data()), "again");
    check_and_repair(again, "again");
    const Sheet read(again);
    EXPECT_EQ(count_pieces(read), count_pieces(sheet)) << method;
    EXPECT_EQ(gap_along_seams(read).alone, gap_along_seams(sheet).alone) << method;
    EXPECT_LT(gap_along_seams(read).largest, 1e-9) << method;
    alone += gap_along_seams(read).alone;
  }
  EXPECT_GT(alone, 15u);
}

/// A vertex of the first side alone, and one of the second alone, between two that both have: all in one line.
TEST(SeamTies, BothSidesAreStraightBetweenWhatBothHave) {
  MeshData mesh;
  mesh.rest = {{0, 0}, {0.3, 0}, {1, 0}, {0, 1}, {3, 0}, {3, 0.6}, {3, 1}, {4, 0}};
  for (const Point2 p : mesh.rest) mesh.deformed.push_back({p.x < 2 ? p.x : p.y, p.x < 2 ? p.y : -1, 0});
  mesh.deformed[7] = {0, -2, 0};
  for (const std::size_t k : {4, 5, 6}) mesh.deformed[k].y = 0;
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {4, 7, 5}, {5, 7, 6}};
  mesh.sewn = {0, 1, 2, 3, 0, 5, 2, 7};
  const Sheet sheet(mesh);
  ASSERT_EQ(sheet.seams().size(), 1u);
  std::map<std::size_t, SeamTie> ties;
  for (const SeamTie& tie : seam_ties(sheet)) ties.emplace(tie.vertex(), tie);
  ASSERT_EQ(ties.size(), 4u);
  for (const auto& [vertex, weight] : {std::pair{1, 0.3}, std::pair{5, 0.6}}) {
    const SeamTie& tie = ties.at(to_size(vertex));
    EXPECT_EQ(tie.masters, (std::array{DeformedIndex(0), DeformedIndex(2)}));
    EXPECT_NEAR(tie.weights[1], weight, 1e-12);
    EXPECT_NEAR(tie.weights[0], 1 - weight, 1e-12);
  }
  EXPECT_EQ(ties.at(4).masters[0], DeformedIndex(0));
  EXPECT_EQ(ties.at(6).masters[0], DeformedIndex(2));
}

/// An opening one edge long on one side, and two on the other, that bulges: not sewn.
TEST(SeamTies, AnOpeningStaysOpen) {
  MeshData mesh;
  mesh.rest = {{0, 0}, {1, 0}, {0, 1}, {3, 0}, {3, 0.6}, {3, 1}, {4, 0}};
  mesh.deformed = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0.6, -0.1, 0}, {1, 0, 0}, {0, -2, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 6, 4}, {4, 6, 5}};
  mesh.sewn = {0, 1, 2, 0, 4, 1, 6};
  EXPECT_TRUE(seams_of(mesh).empty());
  mesh.deformed[4].y = 0;
  EXPECT_EQ(seams_of(mesh).size(), 1u);
}

}  // namespace
}  // namespace cutbench
