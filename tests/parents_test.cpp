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

void expect_vertices(const Sheet& before, const Sheet& after) {
  const auto parents = vertex_parents(after);
  ASSERT_EQ(parents.size(), after.deformed_slots());
  for (std::size_t d = 0; d < parents.size(); ++d) {
    const DeformedIndex vertex(d);
    EXPECT_EQ(parents[d].empty(), !after.rest_vertex(vertex).valid());
    if (parents[d].empty()) continue;
    Point2 rest;
    double sum = 0;
    std::set<DeformedIndex> seen;
    for (const VertexPart& part : parents[d]) {
      ASSERT_TRUE(before.rest_vertex(part.vertex).valid());
      EXPECT_TRUE(seen.insert(part.vertex).second) << "named twice";
      rest = rest + part.weight * before.rest(before.rest_vertex(part.vertex));
      sum += part.weight;
    }
    const Point2 at = after.rest(after.rest_vertex(vertex));
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(rest.x, at.x, 1e-9);
    EXPECT_NEAR(rest.y, at.y, 1e-9);
  }
}

/// \param only_splits  each new triangle is a part of an old one
void expect_triangles(const Sheet& before, const Sheet& after, bool only_splits) {
  const auto parents = triangle_parents(before, after);
  for (std::size_t t = 0; t < parents.size(); ++t) {
    EXPECT_EQ(parents[t].valid(), after.triangle(TriangleIndex(t)).alive());
    if (!parents[t].valid()) continue;
    const auto old = before.corners(parents[t]);
    const auto now = after.corners(TriangleIndex(t));
    EXPECT_GE(least_barycentric(old, (1.0 / 3) * (now[0] + now[1] + now[2])), -1e-9);
    for (const Point2 corner : now) {
      EXPECT_TRUE(!only_splits || least_barycentric(old, corner) >= -1e-9);
    }
  }
}

}  // namespace

TEST(Parents, AreWhereTheirChildrenAre) {
  for (const MethodRow& row : all_methods()) {
    if (!row.promises.exact_incision) continue;
    for (const char* const family : sheet_families())
      for (const char* const cuts : {"curved", "recut", "partial"}) {
        SCOPED_TRACE(row.name + ", " + family + ", " + cuts);
        Sheet sheet(make_sheet(family, 8));
        Locator locator(sheet);
        Cutter cutter;
        const auto method = row.make(row.parameter.value);
        for (const Curve& curve : make_case(cuts, 5, 0, sheet)) {
          const Sheet before = sheet;
          const CutOutcome outcome = cutter.cut(sheet, locator, curve, *method, {});
          if (outcome.status != Status::ok) continue;
          expect_vertices(before, sheet);
          expect_triangles(before, sheet, row.name == "conventional_split");
        }
      }
  }
}

}  // namespace cutbench
