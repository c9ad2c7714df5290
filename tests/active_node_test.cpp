// What the active node leaves behind: a vertex of the path every h, and triangles that none turned over. That its
// incision keeps to the requested curve is in reshape_test.cpp, with the other methods that are held to a tolerance.

#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// Lengths of the edges of all incisions, each once.
std::vector<double> incision_edges(const Sheet& sheet) {
  std::vector<double> lengths;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (!sheet.triangle(TriangleIndex(t)).alive()) break;
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (sheet.mark(h) != EdgeMark::incision || sheet.opposite(h) < h) continue;
      const Point2 along = sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h));
      lengths.push_back(std::hypot(along.x, along.y));
    }
  return lengths;
}

/// A straight cut has ends that must stay and nothing else. Pieces are equal in length there, so each is from 2/3 to
/// 3/2 of the spacing long, the 5 % apart that a vertex may be from its place.
TEST(ActiveNode, LeavesAVertexAtTheSpacing) {
  const MethodRow& row = find_method("active_node");
  std::size_t edges = 0, short_edges = 0;
  for (const std::string family : sheet_families())
    for (const double spacing : {0.5, 1.0, 2.0})
      for (std::size_t i = 0; i < scaled(10); ++i) {
        Sheet sheet(make_sheet(family, 20));
        Locator locator(sheet);
        const auto cuts = make_case("straight", 3, i, sheet);
        ASSERT_EQ(Cutter().cut(sheet, locator, cuts[0], *row.make(spacing), {}).status, Status::ok);
        for (const double length : incision_edges(sheet)) {
          const double pieces = length / (spacing * sheet.mean_edge());
          EXPECT_LT(pieces, 1.5 + 2 * 0.05) << family << " " << i << ", spacing " << spacing;
          ++edges;
          short_edges += pieces < 2.0 / 3 - 2 * 0.05;
        }
      }
  EXPECT_GT(edges, scaled(1000));
  EXPECT_LT(short_edges, edges / 50) << "the node was held up, or stayed where the split had left a vertex";
}

/// Signed areas in long double, of every cut of many in a row; their sum is that of the uncut sheet.
TEST(ActiveNode, TurnsNoTriangleOver) {
  const MethodRow& row = find_method("active_node");
  std::ptrdiff_t removed = 0;
  for (const std::string family : sheet_families())
    for (const char* cuts : {"curved", "cut_out", "several"})
      for (std::size_t i = 0; i < scaled(5); ++i) {
        Sheet sheet(make_sheet(family, 20));
        const Sheet before = sheet;
        const auto total = [](const Sheet& s) {
          long double sum = 0;
          for (std::size_t t = 0; t < s.triangle_slots(); ++t) {
            if (!s.triangle(TriangleIndex(t)).alive()) continue;
            const auto [a, b, c] = s.corners(TriangleIndex(t));
            const long double twice = (static_cast<long double>(b.x) - a.x) * (static_cast<long double>(c.y) - a.y) -
                                      (static_cast<long double>(b.y) - a.y) * (static_cast<long double>(c.x) - a.x);
            EXPECT_GT(twice, 0);
            sum += twice / 2;
          }
          return sum;
        };
        Locator locator(sheet);
        const auto method = row.make(row.parameter.value);
        for (const Curve& curve : make_case(cuts, 11, i, sheet)) {
          EXPECT_EQ(Cutter().cut(sheet, locator, curve, *method, {}).status, Status::ok);
          EXPECT_NEAR(to_double(total(sheet) / total(before)), 1, 1e-12) << family << ", " << cuts << " " << i;
        }
        for (std::size_t v = 0; v < before.vertex_slots(); ++v) {
          const VertexIndex old(v);
          removed += !sheet.triangle_of_vertex(old).valid() || sheet.is_newer(old, before);
        }
      }
  EXPECT_GT(removed, to_index(scaled(100))) << "vertices in the node's way are taken in";
}

}  // namespace
}  // namespace cutbench
