// Texture coordinates through cuts and files: those of the test's own map, at every corner.
#include "harness/mesh/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_text.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

/// Of a place at rest, in a triangle with this centroid.
using Map = std::function<Point2(Point2 rest, Point2 centroid)>;

Point2 linear(Point2 p, Point2 /*centroid*/) { return {3 * p.x - 2 * p.y + 0.5, p.x + 4 * p.y - 1}; }
/// Two islands, of the sheet's left and right half.
Point2 two_islands(Point2 p, Point2 centroid) {
  return centroid.x < 0.5 ? Point2{0.4 * p.x, 0.7 * p.y} : Point2{0.9 - 0.3 * p.y, 2 * p.x + 0.1 * p.y};
}

Point2 centroid_of(const MeshData& mesh, std::size_t t) {
  Point2 sum;
  for (const std::int32_t v : mesh.triangles[t]) sum = sum + mesh.rest[to_size(v)];
  return 1.0 / 3 * sum;
}

Texture textured(const MeshData& mesh, const Map& map) {
  Texture texture;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& corners = texture.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = map(mesh.rest[to_size(mesh.triangles[t][k])], centroid_of(mesh, t));
  }
  return texture;
}

/// The largest difference from the map, over corners of triangles that `counts`.
double error_of(
    const MeshData& mesh, const Texture& texture, const Map& map,
    const std::function<bool(std::size_t)>& counts = [](std::size_t) { return true; }) {
  EXPECT_EQ(texture.size(), mesh.triangles.size());
  const Texture right = textured(mesh, map);
  double error = 0;
  for (std::size_t t = 0; t < texture.size(); ++t)
    for (std::size_t k = 0; counts(t) && k < 3; ++k) error = std::max(error, length(texture[t][k] - right[t][k]));
  return error;
}

struct Textured {
  MeshData mesh;
  Texture texture;
};

/// As through a file.
Textured read_again(const MeshData& mesh, const Texture& texture) {
  const std::string text = textured_obj_text(mesh, texture);
  Textured read{read_obj(text, "m"), {}};
  check_and_repair(read.mesh, "m", true);
  read.texture = read_obj_texture(text, "m", {}, read.mesh);
  return read;
}

Textured cut_once(const Textured& sheet, const MethodRow& row, const char* family, std::size_t number) {
  const Sheet before(sheet.mesh);
  Sheet after = before;
  Locator locator(after);
  Cutter cutter;
  const auto method = row.make(row.parameter.value);
  for (const Curve& curve : make_case(family, 5, number, after)) cutter.cut(after, locator, curve, *method, {});
  return {after.to_mesh_data(), carried_over(sheet.texture, before, after, parents_of(before, after))};
}

}  // namespace

TEST(Texture, ALinearMapIsExactAfterTenCutsOfCuts) {
  for (const MethodRow& row : all_methods()) {
    SCOPED_TRACE(row.name);
    Textured sheet{make_sheet(row.name == "cisamr" ? "grid" : "delaunay", 8), {}};
    sheet.texture = textured(sheet.mesh, linear);
    std::size_t triangles = sheet.mesh.triangles.size();
    for (std::size_t i = 0; i < 10; ++i) {
      const Textured cut = cut_once(sheet, row, i % 2 == 0 ? "curved" : "partial", i);
      ASSERT_LT(error_of(cut.mesh, cut.texture, linear), 1e-12) << "cut " << i;
      sheet = read_again(cut.mesh, cut.texture);
      ASSERT_EQ(sheet.mesh.rest, cut.mesh.rest);
      ASSERT_EQ(sheet.mesh.deformed, cut.mesh.deformed);
      ASSERT_EQ(sheet.mesh.triangles, cut.mesh.triangles);
      ASSERT_EQ(sheet.texture, cut.texture);
      triangles = std::max(triangles, sheet.mesh.triangles.size());
    }
    EXPECT_TRUE(triangles > 128 || row.name == "element_deletion" || row.name == "edge_release");
  }
}

TEST(Texture, EachSideOfASeamKeepsItsOwn) {
  for (const MethodRow& row : all_methods()) {
    SCOPED_TRACE(row.name);
    MeshData grid = make_sheet("grid", 8);
    const Textured sheet{grid, textured(grid, two_islands)};
    const Textured cut = cut_once(sheet, row, "several", 0);
    // Exactly on the seam, rounding says which side a centroid is on.
    const auto counts = [&](std::size_t t) { return std::abs(centroid_of(cut.mesh, t).x - 0.5) > 1e-9; };
    EXPECT_LT(error_of(cut.mesh, cut.texture, two_islands, counts), 1e-12);
    const Textured again = read_again(cut.mesh, cut.texture);
    EXPECT_EQ(again.texture, cut.texture);
    EXPECT_EQ(again.mesh.rest, cut.mesh.rest);
    EXPECT_TRUE(texture_of_vertices(cut.mesh, cut.texture).empty());
  }
}

TEST(Texture, TrianglesThatReadingTurnsTakeTheirCornersAlong) {
  // The second face is clockwise; the vt are ten times as far apart as the v.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 10 0\nvt 10 10\nvt 0 10\nf 1/1 2/2 3/3\nf 1/1 4/4 3/3\n";
  MeshData mesh = read_obj(text, "m");
  EXPECT_TRUE(mesh.rest.empty());
  check_and_repair(mesh, "m");
  const Texture texture = read_obj_texture(text, "m", {}, mesh);
  const Map ten_times = [](Point2 p, Point2) { return 10.0 * p; };
  EXPECT_EQ(error_of(mesh, texture, ten_times), 0);
  EXPECT_EQ(texture_of_vertices(mesh, texture)[2], (Point2{10, 10}));
}

TEST(Texture, OfAPlysVertices) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "s\n"
      "property float t\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string faces = "3 0 1 2\n3 0 3 2\n";  // the second is clockwise
  const std::string text = header + "0 0 0 0 0\n1 0 0 10 0\n1 1 0 10 10\n0 1 0 0 10\n" + faces;
  MeshData mesh = read_ply(text, "m");
  EXPECT_TRUE(mesh.rest.empty());
  check_and_repair(mesh, "m");
  const Map ten_times = [](Point2 p, Point2) { return 10.0 * p; };
  EXPECT_EQ(error_of(mesh, read_ply_texture(text, "m", {}, mesh), ten_times), 0);
  const std::string rest = header + "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n" + faces;
  EXPECT_FALSE(read_ply(rest, "m").rest.empty());
  EXPECT_TRUE(read_ply_texture(rest, "m", {}, mesh).empty());
}

TEST(Texture, NoneWhereTheVtAreRestOrMissing) {
  const MeshData grid = make_sheet("grid", 2);
  EXPECT_TRUE(read_obj_texture(obj_text(grid), "m", {}, grid).empty());
  EXPECT_FALSE(read_obj_texture(obj_text(grid), "m", {RestFrom::plane, false}, grid).empty());
  const std::string part = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 1 3 4\n";
  const MeshReading plane{RestFrom::plane, false};
  EXPECT_TRUE(read_obj_texture(part, "m", plane, read_obj(part, "m", false, plane)).empty());
}

}  // namespace cutbench
