#include "harness/mesh/check_and_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

TEST(CheckAndRepair, RefusalsInMemory) {
  const std::vector<Point3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  auto check = [&](std::vector<std::array<std::int32_t, 3>> triangles, std::vector<Point3> deformed,
                   std::vector<Point2> rest = {}) {
    MeshData mesh{std::move(rest), std::move(deformed), std::move(triangles), {}, {}};
    check_and_repair(mesh, "m");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  expect_refused([&] { check({}, square); }, "m: no triangles");
  expect_refused([&] { check({{0, 1, 5}}, square); }, "triangle 1 of 1 has a corner beyond the 5 vertices");
  expect_refused([&] { check({{0, 1, -1}}, square); }, "triangle 1 of 1 has a corner beyond the 5 vertices");
  expect_refused([&] { check({{0, 1, 2}, {0, 2, 2}}, square); }, "triangle 2 of 2 has the same corner twice");
  expect_refused([&] { check({{0, 1, 2}}, square, {{0, 0}}); }, "1 rest but 5 deformed positions");
  for (double bad : {nan, inf, -inf, 1.1e60, -1.1e60}) {
    expect_refused([&] { check({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {bad, 1, 0}}); }, "vertex 3 of 3 has a coordinate");
    expect_refused([&] { check({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, bad}}); }, "vertex 3 of 3 has a coordinate");
    expect_refused(
        [&] {
          check({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0}, {1, 0}, {1, bad}});
        },
        "vertex 3 of 3 has a coordinate");
  }
  expect_refused([&] { check({{0, 4, 2}}, square); }, "triangle 1 of 1 has zero area");
  expect_refused(
      [&] {
        check({{0, 1, 2}, {0, 2, 3}, {1, 2, 0}}, square);
      },
      "triangle 3 of 3 has the same rest corners");
  expect_refused([&] { check({{0, 1, 2}, {0, 1, 3}}, square); }, "triangle 2 of 2 overlaps triangle 1 in rest space");
  expect_refused([&] { check({{0, 1, 2}, {0, 1, 4}, {0, 1, 3}}, square); }, "three triangles meet at the edge");
  // The same fold and the same duplicate between doubled vertices.
  const std::vector<Point3> twice{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  expect_refused([&] { check({{0, 1, 2}, {3, 4, 5}}, twice); }, "triangle 2 of 2 overlaps triangle 1 in rest space");
  expect_refused(
      [&] {
        check({{0, 1, 2}, {3, 4, 6}}, twice);
      },
      "triangle 2 of 2 has the same rest corners as triangle 1");
}

TEST(CheckAndRepair, MoebiusStripIsRefused) {
  MeshData strip;  // five triangles, each sharing an edge with the next, the last with the first, once twisted
  for (int v = 0; v < 5; ++v) {
    const double angle = 1.2566370614359172 * v;
    strip.rest.push_back({std::cos(angle), std::sin(angle)});
    strip.deformed.push_back({std::cos(angle), std::sin(angle), 0});
    strip.triangles.push_back({v, (v + 1) % 5, (v + 2) % 5});
  }
  expect_refused([&] { check_and_repair(strip, "m"); }, "overlaps");
}

TEST(CheckAndRepair, RepairsInMemory) {
  // Two triangles that meet in a point, one of them clockwise, and two vertices nobody uses (one not even finite).
  MeshData mesh;
  mesh.deformed = {{NAN, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {9, 9, 9}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{1, 2, 3}, {1, 6, 5}};
  check_and_repair(mesh, "m");
  EXPECT_EQ(joined_notes(mesh),
            "m: clockwise triangles reversed: 1 of 2|"
            "m: vertices added where triangles met in a point only: 1|"
            "m: vertices without triangles dropped: 2|");
  ASSERT_EQ(mesh.rest.size(), 6u);
  EXPECT_EQ(mesh.rest[to_size(mesh.triangles[0][0])], (Point2{0, 0}));
  EXPECT_EQ(mesh.rest[to_size(mesh.triangles[1][0])], (Point2{0, 0}));
  EXPECT_NE(mesh.triangles[0][0], mesh.triangles[1][0]);
  expect_sound(mesh);

  MeshData clockwise = make_sheet("delaunay", 5);
  for (auto& [a, b, c] : clockwise.triangles) std::swap(b, c);
  check_and_repair(clockwise, "m");
  EXPECT_EQ(joined_notes(clockwise), "m: clockwise triangles reversed: all 50|");
  expect_sound(clockwise);
}

/// Random triangles of a grid, their corners in any order: bow-ties, unused vertices and turned triangles at once.
TEST(CheckAndRepair, RandomPartsOfAGrid) {
  std::mt19937 random(7);
  for (int run = 0; run < 300; ++run) {
    MeshData mesh = make_sheet(run % 2 ? "alternating" : "grid", 5);
    std::erase_if(mesh.triangles, [&](const auto&) { return random() % 2 == 0; });
    for (auto& triangle : mesh.triangles) std::shuffle(triangle.begin(), triangle.end(), random);
    if (mesh.triangles.empty()) continue;
    const std::size_t triangles = mesh.triangles.size();
    check_and_repair(mesh, "m");
    EXPECT_EQ(mesh.triangles.size(), triangles);
    mesh.notes.clear();
    expect_sound(mesh);
  }
}

}  // namespace
}  // namespace cutbench
