// Paths along edges where an unrolled sheet has its seams.
#include "harness/path/clear_of_seams.h"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <set>

#include "harness/base/random.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/judged_sheet.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

/// Through vertices of `mesh`.
std::vector<AnyCurve> along_edges(const MeshData& mesh, const std::vector<std::int32_t>& vertices, bool closed) {
  PickedCurve path{Curve::Kind::polyline, closed, {}};
  for (const std::int32_t v : vertices) path.picks.push_back({mesh.deformed[to_size(v)], {}});
  return {path};
}

/// A way along edges with the fewest of them.
std::vector<std::int32_t> fewest_edges(const MeshData& mesh, std::int32_t from, std::int32_t to) {
  std::vector<std::set<std::int32_t>> beside(mesh.deformed.size());
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      beside[to_size(p)].insert(q);
      beside[to_size(q)].insert(p);
    }
  std::vector<std::int32_t> before(mesh.deformed.size(), -1);
  before[to_size(to)] = to;
  for (std::deque<std::int32_t> waiting{to}; before[to_size(from)] < 0; waiting.pop_front())
    for (const std::int32_t v : beside[to_size(waiting.front())])
      if (std::exchange(before[to_size(v)], before[to_size(v)] < 0 ? waiting.front() : before[to_size(v)]) < 0)
        waiting.push_back(v);
  std::vector<std::int32_t> way{from};
  while (way.back() != to) way.push_back(before[to_size(way.back())]);
  return way;
}

bool is_on_border(const MeshData& mesh, const std::vector<std::int32_t>& way) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++triangles[std::minmax(p, q)];
  for (std::size_t i = 1; i < way.size(); ++i)
    if (triangles.at(std::minmax(way[i - 1], way[i])) > 1) return false;
  return true;
}

struct CutOnEdges {
  std::size_t pieces, points_added;
  bool divides_no_triangle;
};

CutOnEdges cut_on_edges(const MeshData& raw, const std::vector<AnyCurve>& path) {
  MeshData mesh = unrolled(raw);
  const std::size_t triangles = mesh.triangles.size();
  clear_of_seams(mesh, "mesh", path, "path");
  EXPECT_EQ(mesh.triangles.size(), triangles);
  const Sheet before(mesh);
  const std::vector<Curve> curves = curves_at_rest(path, before, "path").curves;
  Sheet sheet = before;
  Locator locator(sheet);
  Cutter cutter;
  const MethodRow row = find_method("conventional_split");
  const auto method = row.make(0);
  EXPECT_EQ(cut_all(sheet, locator, cutter, curves, *method, {}).status, Status::ok);
  const Judgement judgement = judge_one_by_one(before, sheet, curves, row.promises, row.make(0), {});
  EXPECT_TRUE(judgement.ok) << judgement.problems.front();
  EXPECT_LT(judgement.incision_error, 1e-6);
  return {to_size(judgement.pieces), points_in_space(sheet) - points_in_space(before),
          sheet.triangle_count() == triangles};
}

TEST(ClearOfSeams, EveryLineOfEdgesOfATubeOpens) {
  const MeshData raw = tube(8, 4, 2);
  for (std::int32_t i = 0; i < 8; ++i) {
    const auto path = along_edges(raw, {i, 4 * 8 + i}, false);
    const CutOnEdges cut = cut_on_edges(raw, path);
    EXPECT_EQ(cut.pieces, 1u);
    EXPECT_EQ(cut.points_added, 5u);
    EXPECT_TRUE(cut.divides_no_triangle);
  }
}

TEST(ClearOfSeams, RingsOfEdgesDivideATorus) {
  const int round = 12, along = 7;
  const MeshData raw = torus(round, along);
  const auto ring = [&](int j) {
    std::vector<std::int32_t> vertices(round);
    std::iota(vertices.begin(), vertices.end(), j * round);
    return along_edges(raw, vertices, true).front();
  };
  for (int j = 0; j < along; ++j) {
    EXPECT_EQ(cut_on_edges(raw, {ring(j)}).pieces, 1u);
    EXPECT_EQ(cut_on_edges(raw, {ring(j), ring((j + 3) % along)}).pieces, 2u);
  }
}

TEST(ClearOfSeams, WaysAlongEdgesOfCurvedSheetsOpen) {
  Random random(76);
  std::size_t ways = 0, on_edges = 0;
  const MeshData dome = surface(12, 9, false, [](double u, double v) {
    return Point3{u, v, 0.4 * std::sin(4 * u) * std::sin(3 * v)};
  });
  for (const MeshData& raw : {tube(16, 8, 2), cone(16, 8), dome, sphere(5), torus(16, 9)})
    for (std::size_t k = 0; k < scaled(12); ++k) {
      const auto vertex = [&] { return to_int32(random.below(raw.deformed.size())); };
      const std::vector<std::int32_t> way = fewest_edges(raw, vertex(), vertex());
      if (way.size() < 3 || is_on_border(raw, way)) continue;
      ++ways;
      on_edges += cut_on_edges(raw, along_edges(raw, way, false)).divides_no_triangle;
    }
  EXPECT_GT(on_edges, ways - ways / 50 - 1) << "of " << ways;  // others pass beside a seam
}

/// Those of a garment are where its file has them.
TEST(ClearOfSeams, SeamsOfPanelsStay) {
  MeshData mesh = in_panels(make_sheet("grid", 8), in_quarters);
  const std::vector<Point2> rest = mesh.rest;
  const std::vector<AnyCurve> path{PickedCurve{Curve::Kind::polyline, false, {{{0.5, 0, 0}, {}}, {{0.5, 1, 0}, {}}}}};
  clear_of_seams(mesh, "mesh", path, "path");
  EXPECT_EQ(mesh.rest, rest);
  EXPECT_THROW(curves_at_rest(path, Sheet(mesh), "path"), InputError);
}

}  // namespace
}  // namespace cutbench
