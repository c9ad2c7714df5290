// What must hold for the polygons that a method makes of a cut sheet's triangles.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Sides of triangles in the set that no other one in it has across an unopened edge: from a deformed vertex to the
/// next.
inline std::multimap<DeformedIndex, DeformedIndex> border_of(const Sheet& sheet,
                                                             const std::set<TriangleIndex>& triangles) {
  std::multimap<DeformedIndex, DeformedIndex> border;
  for (const TriangleIndex t : triangles)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (!sheet.separates(h) && triangles.contains(triangle_of(sheet.opposite(h)))) continue;
      const auto& d = sheet.triangle(t).deformed;
      border.emplace(d[to_size(k)], d[to_size(next_corner(k))]);
    }
  return border;
}

/// No triangle is in two; the corners of each go round its one border, which meets none twice; what is inside is
/// inside.
inline void expect_sound(const Sheet& sheet, const std::vector<Polygon>& polygons) {
  std::set<TriangleIndex> all;
  for (const Polygon& polygon : polygons) {
    const std::set<TriangleIndex> triangles(polygon.triangles.begin(), polygon.triangles.end());
    ASSERT_EQ(triangles.size(), polygon.triangles.size());
    ASSERT_GE(triangles.size(), 2u);
    for (const TriangleIndex t : triangles) EXPECT_TRUE(all.insert(t).second) << "a triangle in two polygons";
    const auto border = border_of(sheet, triangles);
    ASSERT_EQ(border.size(), polygon.corners.size());
    std::set<DeformedIndex> used, inside(polygon.inside.begin(), polygon.inside.end());
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const DeformedIndex from = polygon.corners[i], to = polygon.corners[(i + 1) % polygon.corners.size()];
      ASSERT_EQ(border.count(from), 1u);
      EXPECT_EQ(border.find(from)->second, to);
      EXPECT_TRUE(used.insert(from).second);
    }
    // By Euler's formula a disc of T triangles, B of whose sides are on its border, has (T - B + 2) / 2 vertices
    // inside.
    EXPECT_EQ(2 * inside.size(), triangles.size() + 2 - border.size());
    for (const DeformedIndex d : inside) EXPECT_FALSE(used.contains(d));
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (const DeformedIndex corner : sheet.triangle(TriangleIndex(t)).deformed) {
        const bool is_inside = sheet.triangle(TriangleIndex(t)).alive() && inside.contains(corner);
        EXPECT_TRUE(!is_inside || triangles.contains(TriangleIndex(t)));
      }
  }
}

}  // namespace cutbench
