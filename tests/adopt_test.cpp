// A sheet takes over what another program made of it: the methods play that program.

#include "harness/programs/adopt.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut_all.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// Writes nothing but what it was given.
class Copies : public CuttingMethod {
 public:
  explicit Copies(MeshData result) : result_(std::move(result)) {}
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes&) override {
    adopt(sheet, result_);
    trace.along.clear();
  }

 private:
  MeshData result_;
};

/// In another order, with other numbers, begun at other corners, and nowhere in space.
MeshData in_disorder(const MeshData& mesh, Random& random) {
  std::vector<std::size_t> order(mesh.rest.size()), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  MeshData other;
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = i;
    other.rest.push_back(mesh.rest[order[i]]);
    other.deformed.push_back({});
  }
  for (auto triangle : mesh.triangles) {
    for (auto& v : triangle) v = to_int32(number[to_size(v)]);
    std::rotate(triangle.begin(), triangle.begin() + to_index(random.below(3)), triangle.end());
    other.triangles.push_back(triangle);
  }
  for (std::size_t i = other.triangles.size(); i > 1; --i)
    std::swap(other.triangles[i - 1], other.triangles[random.below(i)]);
  return other;
}

/// For each triangle, by its corners in rest space from the smallest on, where they are in space.
std::map<std::array<double, 6>, std::array<Point3, 3>> corners_in_space(const Sheet& sheet) {
  std::map<std::array<double, 6>, std::array<Point3, 3>> all;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    if (!triangle.alive()) continue;
    auto c = sheet.corners(TriangleIndex(t));
    std::size_t first = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (c[k].x < c[first].x || (c[k].x == c[first].x && c[k].y < c[first].y)) first = k;
    std::array<double, 6> key{};
    std::array<Point3, 3> places;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = (first + k) % 3;
      key[2 * k] = c[from].x;
      key[2 * k + 1] = c[from].y;
      places[k] = sheet.position(triangle.deformed[from]);
    }
    all[key] = places;
  }
  return all;
}

/// Cut once, and its lips apart in space: a vertex given to the wrong lip would be seen.
Sheet parted_sheet(const std::string& family) {
  Sheet sheet(lifted(make_sheet(family, 10)));
  Locator locator(sheet);
  const auto method = find_method("conventional_split").make(0);
  EXPECT_EQ(
      Cutter()
          .cut(sheet, locator, {Curve::Kind::polyline, false, {{0.21, 0.33}, {0.52, 0.41}, {0.83, 0.64}}}, *method, {})
          .status,
      Status::ok);
  std::vector<char> left(sheet.deformed_slots(), 0);
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(TriangleIndex(t), k); sheet.mark(h) == EdgeMark::incision)
        if (sheet.rest(sheet.target(h)).x > sheet.rest(sheet.origin(h)).x)
          for (const int corner : {k, next_corner(k)})
            left[sheet.triangle(TriangleIndex(t)).deformed[to_size(corner)]()] = 1;
  for (std::size_t d = 0; d < left.size(); ++d)
    if (left[d]) sheet.set_position(DeformedIndex(d), sheet.position(DeformedIndex(d)) + Point3{0, 0.01, 0.05});
  return Sheet(sheet.to_mesh_data());
}

class Adopt : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Adopt, IsTheSameSheetEverywhere) {
  const auto& [family, method] = GetParam();
  Random random(7);
  for (const char* cuts : {"straight", "curved", "partial", "cut_out", "self_crossing", "along_edges", "u_turn"})
    for (std::size_t i = 0; i < scaled(10); ++i) {
      SCOPED_TRACE(std::string(cuts) + " " + std::to_string(i));
      const Sheet start = parted_sheet(family);
      const std::vector<Curve> curves = make_case(cuts, 3, i, start);
      Sheet expected = start, adopted = start;
      Locator locator(expected), other_locator(adopted);
      const MethodRow& row = find_method(method);
      const Status status = Cutter().cut(expected, locator, curves.front(), *row.make(row.parameter.value), {}).status;
      if (status != Status::ok) continue;
      Copies copies(in_disorder(expected.to_mesh_data(), random));
      ASSERT_EQ(Cutter().cut(adopted, other_locator, curves.front(), copies, {}).status, Status::ok);
      EXPECT_EQ(faults(adopted), "");
      EXPECT_EQ(count_pieces(adopted), count_pieces(expected));
      EXPECT_EQ(adopted.deformed_count(), expected.deformed_count());
      const auto mine = corners_in_space(adopted), theirs = corners_in_space(expected);
      ASSERT_EQ(mine.size(), theirs.size());
      for (const auto& [key, places] : theirs) {
        ASSERT_TRUE(mine.contains(key));
        // Refinement interpolates in triangles that it has changed before, not by the map of the sheet before.
        for (std::size_t k = 0; k < 3 && row.name != "delaunay_refine"; ++k)
          ASSERT_LT(length(places[k] + -1 * mine.at(key)[k]), 1e-9) << key[2 * k] << ' ' << key[2 * k + 1];
      }
      adopted.rollback();
      EXPECT_EQ(difference(start, adopted), "");
    }
}

INSTANTIATE_TEST_SUITE_P(Programs, Adopt,
                         testing::Combine(testing::Values("grid", "alternating", "delaunay", "graded"),
                                          testing::Values("conventional_split", "delaunay_refine", "snap_or_split")),
                         [](const auto& parameter) {
                           return std::string(std::get<0>(parameter.param)) + "_" + std::get<1>(parameter.param);
                         });

/// Meshed anew: hardly a triangle or a vertex of the sheet is left.
TEST(Adopt, TakesOverANewMesh) {
  for (const std::string family : sheet_families()) {
    const Sheet start(lifted(make_sheet(family, 12)));
    const Curve path{Curve::Kind::bezier, false, {{-0.1, 0.3}, {0.3, 0.9}, {0.6, 0.1}, {1.1, 0.7}}};
    Sheet remeshed = start, adopted = start;
    Locator locator(remeshed), other_locator(adopted);
    ASSERT_EQ(Cutter().cut(remeshed, locator, path, *find_method("global_remesh").make(0), {}).status, Status::ok);
    Copies copies(remeshed.to_mesh_data());
    ASSERT_EQ(Cutter().cut(adopted, other_locator, path, copies, {}).status, Status::ok);
    EXPECT_EQ(faults(adopted), "");
    EXPECT_EQ(adopted.triangle_count(), remeshed.triangle_count());
    EXPECT_NEAR(surface_area(adopted), surface_area(start), 0.02 * surface_area(start));
  }
}

TEST(Adopt, RefusesToLoseAHeldVertex) {
  Sheet sheet(make_sheet("grid", 6));
  Sheet other = sheet;
  Locator locator(sheet), other_locator(other);
  const Curve path{Curve::Kind::polyline, false, {{-0.1, 0.4}, {1.1, 0.55}}};
  ASSERT_EQ(Cutter().cut(other, other_locator, path, *find_method("global_remesh").make(0), {}).status, Status::ok);
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) sheet.hold(VertexIndex(v));
  const Sheet before = sheet;
  Copies copies(other.to_mesh_data());
  const CutOutcome outcome = Cutter().cut(sheet, locator, path, copies, {});
  EXPECT_EQ(outcome.status, Status::refused);
  EXPECT_NE(outcome.reason.find("holds"), std::string::npos) << outcome.reason;
  EXPECT_EQ(difference(before, sheet), "");
}

}  // namespace
}  // namespace cutbench
