#include "harness/mesh/families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "harness/base/conversions.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/quality.h"

namespace cutbench {
namespace {

std::vector<std::array<Point2, 3>> rest_triangles(const MeshData& mesh) {
  std::vector<std::array<Point2, 3>> result;
  for (const auto& [a, b, c] : mesh.triangles)
    result.push_back({mesh.rest[to_size(a)], mesh.rest[to_size(b)], mesh.rest[to_size(c)]});
  return result;
}

TEST(Families, CountsAreaAndSoundness) {
  for (const std::string family : sheet_families())
    for (int n : {1, 2, 3, 4, 5, 7, 10, 20, 30, 40, 50, 60, 70, 80}) {
      SCOPED_TRACE(family + " " + std::to_string(n));
      MeshData mesh = make_sheet(family, n);
      EXPECT_EQ(mesh.triangles.size(), to_size(2 * n * n));
      EXPECT_EQ(mesh.rest.size(), to_size((n + 1) * (n + 1)));
      double area = 0;
      for (const auto& [a, b, c] : rest_triangles(mesh)) area += cross(b - a, c - a) / 2;
      EXPECT_NEAR(area, 1, 1e-12);
      std::ptrdiff_t on_border = 0;
      for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
        const Point2 p = mesh.rest[v];
        EXPECT_EQ(mesh.deformed[v], (Point3{p.x, p.y, 0}));
        on_border += p.x == 0 || p.x == 1 || p.y == 0 || p.y == 1;
      }
      EXPECT_EQ(on_border, 4 * n);
      const auto before = mesh.triangles;
      check_and_repair(mesh, family);  // counter-clockwise, manifold, nothing unused
      EXPECT_TRUE(mesh.notes.empty());
      EXPECT_EQ(mesh.triangles, before);
    }
}

TEST(Families, Shapes) {
  for (int n : {20, 30, 40, 50, 60, 70, 80}) {
    SCOPED_TRACE(n);
    EXPECT_NEAR(quality(rest_triangles(make_sheet("grid", n))).ar_max, 2, 1e-9);
    EXPECT_NEAR(quality(rest_triangles(make_sheet("alternating", n))).ar_max, 2, 1e-9);
    const Quality delaunay = quality(rest_triangles(make_sheet("delaunay", n)));
    EXPECT_LT(delaunay.ar_max, 3);
    EXPECT_LT(delaunay.ar_mean, 1.55);
    EXPECT_LT(quality(rest_triangles(make_sheet("graded", n))).ar_max, 3);
  }
}

TEST(Families, GradedIsFineAtTheCorner) {
  double shortest = 1, longest = 0, nearest_to_corner = 1;
  for (const auto& t : rest_triangles(make_sheet("graded", 40)))
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = std::sqrt(squared_length(t[(k + 1) % 3] - t[k]));
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
      if (t[k] == Point2{}) nearest_to_corner = std::min(nearest_to_corner, length);
    }
  EXPECT_EQ(shortest, nearest_to_corner);
  EXPECT_GT(longest / shortest, 8);
  EXPECT_LT(longest / shortest, 18);
}

TEST(Families, DelaunayHasNoPointInsideACircumcircle) {
  const MeshData mesh = make_sheet("delaunay", 8);
  for (const auto& [a, b, c] : rest_triangles(mesh))
    for (Point2 p : mesh.rest) {
      const Point2 u = a - p, v = b - p, w = c - p;  // the in-circle determinant
      const double inside =
          squared_length(u) * cross(v, w) + squared_length(v) * cross(w, u) + squared_length(w) * cross(u, v);
      EXPECT_LE(inside, 1e-15);
    }
}

/// The records of years depend on these bits: any change of them is a new suite version.
TEST(Families, DelaunayIsTheSameEverywhere) {
  const MeshData mesh = make_sheet("delaunay", 20);
  std::uint64_t hash = 0;
  for (Point2 p : mesh.rest)
    for (double x : {p.x, p.y}) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001B3u;
  for (const auto& triangle : mesh.triangles)
    for (std::int32_t v : triangle) hash = (hash ^ static_cast<std::uint64_t>(v)) * 0x100000001B3u;
  EXPECT_EQ(hash, 4495426414984311048u);
}

std::string error_of(const std::string& family, int n) {
  try {
    make_sheet(family, n);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

TEST(Families, UnknownOnesAreRefused) {
  EXPECT_EQ(error_of("hexagons", 4),
            "sheet family 'hexagons' is unknown; choose one of grid, alternating, delaunay, graded");
  EXPECT_EQ(error_of("grid", 0), "sheet 'grid': n = 0 squares a side; choose 1 to 2000");
  EXPECT_EQ(error_of("grid", 2001), "sheet 'grid': n = 2001 squares a side; choose 1 to 2000");
}

}  // namespace
}  // namespace cutbench
