// A file's winding through cuts: a flat sheet of four panels, one of them mirrored at rest, keeps its upper side up.
#include "harness/mesh/winding.h"

#include <gtest/gtest.h>

#include <utility>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/path/pick.h"
#include "methods/registry.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

std::size_t upside_down(const MeshData& mesh) {
  std::size_t count = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto p = [&](std::size_t k) { return mesh.deformed[to_size(triangle[k])]; };
    count += (p(1).x - p(0).x) * (p(2).y - p(0).y) < (p(2).x - p(0).x) * (p(1).y - p(0).y);
  }
  return count;
}

TEST(Winding, OfAMirroredPanelIsThatOfTheFileAfterACut) {
  const MeshData read = in_panels(make_sheet("delaunay", 8), in_quarters);
  EXPECT_GT(upside_down(read), 0u);
  const Sheet before(read);
  const PickedCurve across{
      Curve::Kind::polyline, false, {{{0.1, 0.2, 0}, {}}, {{0.2, 0.83, 0}, {}}, {{0.9, 0.7, 0}, {}}}};
  for (const MethodRow& row : all_methods()) {
    SCOPED_TRACE(row.name);
    if (row.name == "cisamr") continue;  // on grids alone
    Sheet cut = before;
    Locator locator(cut);
    Cutter cutter;
    const auto method = row.make(row.parameter.value);
    for (const Curve& curve : Picker(before).rest_curves(across, "it")) cutter.cut(cut, locator, curve, *method, {});
    MeshData result = cut.to_mesh_data();
    EXPECT_GT(upside_down(result), 0u);
    const auto at_rest = result.triangles;
    Texture texture;  // the numbers of the corners
    for (const auto& triangle : at_rest) {
      auto& corners = texture.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) corners[k] = {to_double(triangle[k]), 0};
    }
    wind_as_read(read, cut, parents_of(before, cut), result, texture);
    EXPECT_EQ(upside_down(result), 0u);
    for (std::size_t t = 0; t < texture.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(texture[t][k].x, to_double(result.triangles[t][k]));
    turn_clockwise_parts(read, result);
    EXPECT_EQ(result.triangles, at_rest);
  }
}

TEST(Winding, OneTriangleAgainstItsNeighboursIsAFault) {
  MeshData mesh = make_sheet("grid", 4);
  const auto right = mesh.triangles;
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  check_and_repair(mesh, "it");
  EXPECT_TRUE(mesh.clockwise.empty());
  // In a result it stays as it is, for the judge to name.
  MeshData all = make_sheet("grid", 4);
  for (auto& triangle : all.triangles) std::swap(triangle[1], triangle[2]);
  check_and_repair(all, "it");
  EXPECT_EQ(all.clockwise, std::vector<std::uint8_t>(right.size(), 1));
  EXPECT_EQ(all.triangles, right);
  MeshData result = all;
  std::swap(result.triangles[3][0], result.triangles[3][1]);
  const auto wrong = result.triangles;
  turn_clockwise_parts(all, result);
  EXPECT_EQ(result.triangles, wrong);
}

}  // namespace
}  // namespace cutbench
