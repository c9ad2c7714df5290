// The locator against a look at every triangle and every border edge.

#include "harness/mesh/locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/cases/cut_families.h"
#include "harness/mesh/predicates.h"
#include "harness/path/walk.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

bool holds(const Sheet& sheet, TriangleIndex t, Point2 p) {
  const auto c = sheet.corners(t);
  return orientation(c[0], c[1], p) >= 0 && orientation(c[1], c[2], p) >= 0 && orientation(c[2], c[0], p) >= 0;
}

/// Sheets as they are, and after some cuts.
template <class Test>
void with_sheets(Test test) {
  for (const auto& [name, mesh] : test_meshes(7)) {
    SCOPED_TRACE(name);
    Sheet sheet(mesh);
    Locator locator(sheet);
    test(sheet, locator);
    Cutter cutter;
    const auto method = all_methods().front().make(0);
    for (const char* family : {"several", "cut_out"})
      for (const Curve& curve : make_case(family, 3, 0, sheet)) cutter.cut(sheet, locator, curve, *method, {});
    test(sheet, locator);
  }
}

TEST(Locator, FindsTheTriangleOfAPoint) {
  with_sheets([](const Sheet& sheet, const Locator& locator) {
    const SheetExtent extent = extent_of(sheet);
    Random random(4);
    for (std::size_t i = 0; i < scaled(200); ++i) {
      const Point2 p{random.between(extent.low.x - 0.1, extent.high.x + 0.1),
                     random.between(extent.low.y - 0.1, extent.high.y + 0.1)};
      EXPECT_TRUE(sheet.triangle(locator.near(sheet, p)).alive());
      Walk walk(sheet, locator);
      const Place place = walk.locate(p);
      bool inside = false;
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
        inside |= sheet.triangle(TriangleIndex(t)).alive() && holds(sheet, TriangleIndex(t), p);
      EXPECT_EQ(place.kind != Place::Kind::outside, inside) << p.x << " " << p.y;
      EXPECT_TRUE(place.kind != Place::Kind::face || holds(sheet, place.face, p));
    }
  });
}

TEST(Locator, FindsVerticesAndEdges) {
  with_sheets([](const Sheet& sheet, const Locator& locator) {
    Walk walk(sheet, locator);
    for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) {
      const Place place = walk.locate(sheet.rest(VertexIndex(v)));
      EXPECT_EQ(place.kind, Place::Kind::vertex);
      EXPECT_EQ(place.vertex, VertexIndex(v));
    }
    Random random(5);
    for (std::size_t i = 0; i < scaled(100); ++i) {
      const HalfEdge h = any_half_edge(sheet, random);
      const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
      const Place place = walk.locate(a + random.between(0.2, 0.8) * (b - a));
      EXPECT_EQ(place.kind, Place::Kind::edge);
      EXPECT_TRUE(place.edge == h || place.edge == sheet.opposite(h));
    }
  });
}

/// Every border edge that a segment meets is visited before its place is said to be covered: upright, level and sloping
/// segments in both directions, from inside, outside and far away.
TEST(Locator, VisitsTheBorderInOrder) {
  with_sheets([](const Sheet& sheet, const Locator& locator) {
    const SheetExtent extent = extent_of(sheet);
    Random random(6);
    const auto point = [&] {
      return Point2{random.between(extent.low.x - 0.3, extent.high.x + 0.3),
                    random.between(extent.low.y - 0.3, extent.high.y + 0.3)};
    };
    for (std::size_t i = 0; i < scaled(200); ++i) {
      Point2 a = point(), b = point();
      if (i % 4 == 1) b.x = a.x;
      if (i % 4 == 2) b.y = a.y;
      if (i % 8 == 3) b.x = a.x + 1e-14 * (b.x - a.x);
      if (i % 8 == 7) a = b + 100 * (a - b);
      std::set<HalfEdge> visited;
      double covered = 0;
      std::vector<std::pair<HalfEdge, double>> seen_at;
      locator.visit_border(
          sheet, a, b,
          [&](HalfEdge h) {
            EXPECT_TRUE(sheet.on_border(h));
            if (visited.insert(h).second) seen_at.emplace_back(h, covered);
          },
          [&](double s) {
            EXPECT_GE(s, covered);
            covered = s;
            return false;
          });
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
        for (int k = 0; k < 3 && sheet.triangle(TriangleIndex(t)).alive(); ++k) {
          const HalfEdge h = half_edge(TriangleIndex(t), k);
          if (!sheet.on_border(h)) continue;
          const Point2 u = sheet.rest(sheet.origin(h)), v = sheet.rest(sheet.target(h));
          if (orientation(a, b, u) * orientation(a, b, v) > 0 || orientation(u, v, a) * orientation(u, v, b) > 0)
            continue;
          ASSERT_TRUE(visited.contains(h)) << "segment " << i;
          const double at = cross(u - a, v - u) / cross(b - a, v - u);
          for (const auto& [seen, when] : seen_at) EXPECT_TRUE(seen != h || at >= when - 1e-9) << "segment " << i;
        }
    }
  });
}

}  // namespace
}  // namespace cutbench
