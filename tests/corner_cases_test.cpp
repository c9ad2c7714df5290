// Cuts that other programs failed at, by name: every method must get each right.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_data.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr auto polyline = Curve::Kind::polyline;
constexpr auto bezier = Curve::Kind::bezier;

/// A cut and what must come of it.
struct Step {
  Curve curve;
  int pieces;
  Status status = Status::ok;
};
struct Case {
  std::string name;
  std::vector<Step> steps;
};

/// Cuts of the unit square in 4 x 4 squares.
std::vector<Case> cases() {
  const auto line = [](Point2 a, Point2 b) { return Curve{polyline, false, {a, b}}; };
  const auto chain = [](std::vector<Point2> points) { return Curve{polyline, false, std::move(points)}; };
  const auto loop = [](std::vector<Point2> points) { return Curve{polyline, true, std::move(points)}; };
  const auto curve = [](std::vector<Point2> points) { return Curve{bezier, false, std::move(points)}; };
  const auto noop = Status::noop;
  std::vector<Case> all{
      {"through_vertices_on_the_diagonal", {{line({-1, -1}, {2, 2}), 2}}},
      {"through_vertices_from_corner_to_corner", {{line({0, 0}, {1, 1}), 2}}},
      {"through_vertices_across_diagonals", {{line({0, 1}, {1, 0}), 2}}},
      {"through_one_vertex", {{line({-0.1, 0.41}, {1.1, 0.59}), 2}}},
      {"along_a_row", {{line({0, 0.5}, {1, 0.5}), 2}}},
      {"along_a_column", {{line({0.25, 2}, {0.25, -1}), 2}}},
      {"along_one_edge", {{line({0.25, 0.5}, {0.5, 0.5}), 1}}},
      {"along_part_of_an_edge", {{line({0.3, 0.5}, {0.45, 0.5}), 1}}},
      {"along_edges_round_a_corner", {{chain({{0.5, 0}, {0.5, 0.5}, {1, 0.5}}), 2}}},
      {"tip_on_a_vertex", {{line({-0.1, 0.4}, {0.5, 0.5}), 1}}},
      {"tip_on_an_edge", {{line({-0.1, 0.4}, {0.5, 0.6}), 1}}},
      {"both_tips_on_edges_of_one_triangle", {{line({0.25, 0.6}, {0.375, 0.625}), 1}}},
      {"tip_on_the_border", {{line({0.3, 0.3}, {0, 0.4}), 1}}},
      {"tip_on_a_border_vertex", {{line({0.3, 0.3}, {0, 0.5}), 1}}},
      {"zero_length", {{line({0.3, 0.4}, {0.3, 0.4}), 1, noop}}},
      {"all_control_points_equal", {{curve({{0.3, 0.4}, {0.3, 0.4}, {0.3, 0.4}, {0.3, 0.4}}), 1, noop}}},
      {"control_points_repeated", {{curve({{-0.1, 0.4}, {-0.1, 0.4}, {1.1, 0.7}, {1.1, 0.7}}), 2}}},
      {"points_repeated", {{chain({{-0.1, 0.4}, {-0.1, 0.4}, {0.6, 0.6}, {0.6, 0.6}, {1.1, 0.7}}), 2}}},
      {"the_same_again", {{line({-0.1, 0.4}, {1.1, 0.7}), 2}, {line({-0.1, 0.4}, {1.1, 0.7}), 2, noop}}},
      {"the_same_backwards", {{line({-0.1, 0.4}, {1.1, 0.7}), 2}, {line({1.1, 0.7}, {-0.1, 0.4}), 2, noop}}},
      {"there_and_back", {{chain({{0.1, 0.4}, {0.7, 0.6}, {0.1, 0.4}}), 1}}},
      {"four_through_one_point",
       {{line({-0.1, 0.4}, {1.1, 0.52}), 2},
        {line({0.4, -0.1}, {0.52, 1.1}), 4},
        {line({-0.1, -0.1}, {1.1, 1.1}), 6},
        {line({-0.1, 0.82 / 0.9 + 0.1}, {1.1, 0.82 / 0.9 - 1.1}), 8}}},
      {"four_through_one_vertex",
       {{line({0, 0.5}, {1, 0.5}), 2},
        {line({0.5, 0}, {0.5, 1}), 4},
        {line({0, 0}, {1, 1}), 6},
        {line({0, 1}, {1, 0}), 8}}},
      {"loop_in_one_triangle", {{loop({{0.3, 0.26}, {0.4, 0.27}, {0.38, 0.35}}), 2}}},
      {"slit_in_one_triangle", {{line({0.3, 0.27}, {0.4, 0.3}), 1}}},
      {"loop_round_one_vertex", {{loop({{0.4, 0.4}, {0.6, 0.45}, {0.55, 0.6}, {0.45, 0.58}}), 2}}},
      {"loop_of_one_triangle", {{loop({{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.5}}), 2}}},
      {"loops_of_two_triangles_at_one_vertex",
       {{loop({{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.5}}), 2}, {loop({{0.5, 0.5}, {0.75, 0.5}, {0.75, 0.75}}), 3}}},
      {"figure_eight", {{loop({{0.2, 0.3}, {0.8, 0.7}, {0.8, 0.3}, {0.2, 0.7}}), 3}}},
      {"cusp", {{curve({{0.1, 0.2}, {1.1, 0.9}, {-0.1, 0.9}, {0.9, 0.2}}), 2}}},
      {"leaves_and_comes_back", {{chain({{-0.1, 0.3}, {0.4, 0.3}, {0.6, -0.4}, {0.7, 0.4}, {1.2, 0.4}}), 3}}},
      {"wholly_outside", {{line({-0.1, -0.2}, {1.3, -0.1}), 1, noop}}},
      {"past_a_corner", {{line({-0.5, 0.4}, {0.4, -0.5}), 1, noop}}},
      {"touches_a_corner", {{line({-0.5, 0.5}, {0.5, -0.5}), 1, noop}}},
      {"along_the_border", {{line({-0.5, 0}, {1.5, 0}), 1, noop}}},
      {"along_the_border_and_in", {{chain({{0.1, 0}, {0.6, 0}, {0.7, 0.5}}), 1}}},
      {"tee", {{line({-0.1, 0.4}, {1.1, 0.7}), 2}, {line({0.5, 0.55}, {0.4, 1.1}), 3}}},
      {"tip_to_tip", {{line({-0.1, 0.4}, {0.6, 0.7}), 1}, {line({0.6, 0.7}, {1.1, 0.3}), 2}}},
      {"wye",
       {{line({0.5, 0.6}, {0.1, 1.1}), 1}, {line({0.5, 0.6}, {0.9, 1.1}), 2}, {line({0.5, 0.6}, {0.5, -0.1}), 3}}},
      {"u_turn_behind_an_edge", {{chain({{0.3, -0.1}, {0.35, 0.2500001}, {0.4, -0.1}}), 2}}},
  };
  for (int k = 1; k <= 17; ++k) {
    const double e = std::pow(10.0, -k);
    const std::string name = "_1e" + std::to_string(k);
    all.push_back({"grazes_a_row" + name, {{line({-0.1, 0.5 + e}, {1.1, 0.5 + e}), 2}}});
    all.push_back({"grazes_a_vertex" + name, {{line({-0.1, 0.41 + e}, {1.1, 0.59 + e}), 2}}});
    all.push_back({"tip_near_a_vertex" + name, {{line({-0.1, 0.4}, {0.5 + e, 0.5}), 1}}});
    all.push_back({"tip_near_an_edge" + name, {{line({-0.1, 0.4}, {0.5 + e, 0.6}), 1}}});
    if (k == 12 || k == 13) continue;  // the snap distance: either is right
    const Step second{line({-0.1, 0.4 + e}, {1.1, 0.7 - e}), k < 12 ? 4 : 2, k < 12 ? Status::ok : noop};
    all.push_back({"narrow_wedge" + name, {{line({-0.1, 0.4}, {1.1, 0.7}), 2}, second}});
  }
  return all;
}

class CornerCases : public testing::TestWithParam<const MethodRow*> {};

TEST_P(CornerCases, ComeOutRight) {
  const MethodRow& row = *GetParam();
  for (const Case& c : cases())
    for (const char* family : {"grid", "alternating"})
      for (double chord : {0.05, infinite}) {
        Table table(make_sheet(family, 4), row, row.parameter.value);
        std::size_t i = 0;
        for (const Step& step : c.steps) {
          SCOPED_TRACE(c.name + ", cut " + std::to_string(i++) + ", " + family + ", chord tolerance " +
                       std::to_string(chord));
          EXPECT_EQ(table.cut(step.curve, chord), "");
          // Cuts that were made elsewhere than asked for meet the next one elsewhere: there the oracle alone judges.
          if (i > 1 && !row.promises.exact_incision) continue;
          EXPECT_EQ(table.judgement.pieces, step.pieces);
          EXPECT_STREQ(name_of(table.outcome.status), name_of(step.status));
        }
      }
}

/// From the outside into the hole, across it, round it.
TEST_P(CornerCases, SheetWithAHole) {
  const MethodRow& row = *GetParam();
  const MeshData mesh = read_mesh(CUTBENCH_TEST_CASES "/meshes/skfem_annulus.off");
  const Sheet sheet(mesh);
  Point2 middle;
  for (Point2 p : mesh.rest) middle = middle + 1.0 / to_double(mesh.rest.size()) * p;
  const double size = sheet.size();
  const Point2 along{size, 0.1 * size}, aside{-0.1 * size, size};
  Table table(mesh, row, row.parameter.value);
  EXPECT_EQ(table.cut({polyline, false, {middle, middle + along}}, 0.05), "");
  EXPECT_EQ(table.judgement.pieces, 1);
  EXPECT_EQ(table.cut({polyline, false, {middle - aside, middle + aside}}, 0.05), "");
  EXPECT_EQ(table.judgement.pieces, 3);
}

/// Triangles round a vertex, some of them thin, and in `angles` those of their edges.
MeshData fan(Random& random, std::vector<double>& angles) {
  constexpr double turn = 2 * std::numbers::pi;
  const auto is_good = [&] {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double gap = (i + 1 < angles.size() ? angles[i + 1] : angles[0] + turn) - angles[i];
      if (gap < 1e-4 || gap > 2.6) return false;
    }
    return true;
  };
  do {
    angles.clear();
    for (std::size_t i = 0, n = 5 + random.below(5); i < n; ++i) angles.push_back(random.between(0, turn));
    for (std::size_t i = 0, n = 1 + random.below(3); i < n; ++i)
      angles.push_back(std::fmod(angles[random.below(angles.size())] + std::pow(10.0, random.between(-3, 0)), turn));
    std::sort(angles.begin(), angles.end());
  } while (!is_good());
  MeshData mesh;
  mesh.rest = {random.coin() ? Point2{} : Point2{0.5, 0.3}};
  const auto n = to_int32(angles.size());
  for (const double a : angles)
    mesh.rest.push_back(mesh.rest[0] + random.between(0.8, 1.2) * Point2{std::cos(a), std::sin(a)});
  for (std::int32_t i = 0; i < n; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  for (const Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
  return mesh;
}

/// Within some snap distances of the middle of a fan several edges are as near to a corner of the path: where the path
/// comes back to it from another side, it must be on the same one, or the loop stays open.
TEST(CornersMetAgain, CloseTheLoop) {
  std::size_t refused = 0;
  for (std::size_t i = 0; i < scaled(3000); ++i) {
    Random random(i);
    std::vector<double> angles;
    Table table(fan(random, angles), find_method("conventional_split"), 0);
    const Point2 middle = table.sheet.rest(VertexIndex(0));
    const auto at = [&](double angle, double distance) {
      return middle + distance * Point2{std::cos(angle), std::sin(angle)};
    };
    const auto anywhere = [&] { return at(random.between(0, 7), random.between(0.05, 0.35)); };
    const double off_an_edge[] = {0, random.between(-1e-3, 1e-3), random.between(-0.05, 0.05), random.between(-3, 3)};
    const Point2 corner = at(angles[random.below(angles.size())] + off_an_edge[random.below(4)],
                             table.sheet.snap() * std::pow(10.0, random.between(0, 3)));
    std::vector<Point2> points{corner, anywhere(), anywhere(), corner};
    if (random.coin()) points.insert(points.begin(), anywhere());
    if (random.coin()) points.push_back(anywhere());
    const Curve path{polyline, false, points};
    const std::string wrong = table.cut(path, 0.05);
    if (table.outcome.status == Status::refused) {
      ++refused;
      continue;
    }
    EXPECT_EQ(wrong, "") << i << ": " << text_of(path);
    EXPECT_GE(table.judgement.pieces, 2) << i << ": " << text_of(path);
  }
  EXPECT_LE(refused, scaled(3000) / 100) << "declared, but not for many: crossings too close together for doubles";
}

INSTANTIATE_TEST_SUITE_P(Methods, CornerCases, testing::ValuesIn([] {
                           std::vector<const MethodRow*> rows;
                           for (const MethodRow& row : whole_sheet_methods()) rows.push_back(&row);
                           return rows;
                         }()),
                         [](const auto& row) { return row.param->name; });

}  // namespace
}  // namespace cutbench
