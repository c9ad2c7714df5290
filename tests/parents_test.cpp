// What a cut sheet's vertices and triangles were before, checked by where they are.
#include "harness/mesh/parents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "harness/cases/cut_families.h"
#include "harness/cut/cut.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

/// Of a counter-clockwise triangle: below 0 outside.
double least_barycentric(const std::array<Point2, 3>& t, Point2 p) {
  const double area2 = cross(t[1] - t[0], t[2] - t[0]);
  return std::min({cross(t[1] - t[0], p - t[0]), cross(t[2] - t[1], p - t[1]), cross(t[0] - t[2], p - t[2])}) / area2;
}

/// \param one_to_one  new triangles are parts of old ones
void expect_parents(const Sheet& before, const Sheet& after, bool one_to_one) {
  const Parents parents = parents_of(before, after);
  ASSERT_EQ(parents.vertices.size(), after.deformed_slots());
  for (std::size_t d = 0; d < after.deformed_slots(); ++d) {
    const DeformedIndex vertex(d);
    EXPECT_EQ(parents.vertices[d].empty(), !after.rest_vertex(vertex).valid());
    if (parents.vertices[d].empty()) continue;
    Point2 rest;
    double sum = 0;
    std::set<DeformedIndex> seen;
    for (const VertexPart& part : parents.vertices[d]) {
      ASSERT_TRUE(before.rest_vertex(part.vertex).valid());
      EXPECT_TRUE(seen.insert(part.vertex).second) << "named twice";
      rest = rest + part.weight * before.rest(before.rest_vertex(part.vertex));
      sum += part.weight;
    }
    const Point2 at = after.rest(after.rest_vertex(vertex));
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(rest.x, at.x, 1e-14);
    EXPECT_NEAR(rest.y, at.y, 1e-14);
  }
  ASSERT_EQ(parents.triangles.size(), after.triangle_slots());
  for (std::size_t t = 0; t < after.triangle_slots(); ++t) {
    EXPECT_EQ(parents.triangles[t].valid(), after.triangle(TriangleIndex(t)).alive());
    if (!parents.triangles[t].valid()) continue;
    const auto old = before.corners(parents.triangles[t]);
    const auto now = after.corners(TriangleIndex(t));
    EXPECT_GE(least_barycentric(old, (1.0 / 3) * (now[0] + now[1] + now[2])), -1e-12);
    for (const Point2 corner : now) {
      EXPECT_TRUE(!one_to_one || least_barycentric(old, corner) >= -1e-9);
    }
  }
}

}  // namespace

TEST(Parents, AreWhereTheirChildrenAre) {
  for (const MethodRow& row : all_methods()) {
    for (const char* const family : sheet_families())
      for (const char* const cuts : {"curved", "recut", "partial", "several"}) {
        SCOPED_TRACE(row.name + ", " + family + ", " + cuts);
        const Sheet before(make_sheet(family, 8));
        Sheet sheet = before;
        Locator locator(sheet);
        Cutter cutter;
        const auto method = row.make(row.parameter.value);
        for (const Curve& curve : make_case(cuts, 5, 0, sheet)) cutter.cut(sheet, locator, curve, *method, {});
        expect_parents(before, sheet, row.name == "conventional_split");
      }
  }
}

}  // namespace cutbench
