// Storms of random edits: check() after every one, what the log says about them, and their undoing.

#include "harness/mesh/edit_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "harness/base/conversions.h"
#include "harness/cut/open.h"
#include "harness/mesh/predicates.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// p makes positive triangles with all three edges of t, but for the one it lies on.
bool fits(const Sheet& sheet, TriangleIndex t, Point2 p, HalfEdge lies_on = {}) {
  for (int k = 0; k < 3; ++k)
    if (const HalfEdge h = half_edge(t, k);
        h != lies_on && orientation(sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h)), p) <= 0)
      return false;
  return true;
}

/// One random edit of any kind.
void edit(Sheet& sheet, Random& random) {
  const HalfEdge h = any_half_edge(sheet, random), o = sheet.opposite(h);
  const VertexIndex v = sheet.origin(h);
  const auto c = sheet.corners(triangle_of(h));
  const double size = std::sqrt(squared_length(c[1] - c[0]));
  const auto kind = random.below(9);
  if (kind == 0) {
    const double lambda = random.between(0.3, 0.7);
    const Point2 a = sheet.rest(v), p = a + lambda * (sheet.rest(sheet.target(h)) - a);
    if (fits(sheet, triangle_of(h), p, h) && (!o.valid() || fits(sheet, triangle_of(o), p, o)))
      sheet.split_edge(h, lambda, p);
  } else if (kind == 1) {
    const Point2 p = 0.4 * c[0] + (0.3 * c[1] + 0.3 * c[2]);
    if (fits(sheet, triangle_of(h), p)) sheet.split_triangle(triangle_of(h), p);
  } else if (kind <= 3) {
    sheet.flip(h);
  } else if (kind == 4) {
    const HalfEdge first = sheet.first_outgoing(v);
    if (!sheet.on_border(first)) {
      const double step = random.between(0, 0.3) * size;
      sheet.move(v, sheet.rest(v) + step * random.direction());
    }
  } else if (kind <= 7) {
    sheet.collapse(h);
  } else if (random.coin(0.2) && sheet.mark(h) == EdgeMark::none) {
    sheet.set_mark(h, EdgeMark::path);
  }
}

MeshData storm_mesh(std::size_t i) {
  static const auto meshes = test_meshes(5);
  return lifted(meshes[i % meshes.size()].mesh);
}

/// Weights add up to 1 and, applied in order to the positions before the cut, give the positions after it.
void expect_log_reproduces(const Sheet& before, const Sheet& after) {
  std::map<DeformedIndex, Point3> positions;
  const auto position = [&](DeformedIndex d) {
    const auto known = positions.find(d);
    return known != positions.end() ? known->second : before.position(d);
  };
  for (const auto& [vertex, parents, weights] : after.log().ancestry) {
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
    Point3 x;
    for (std::size_t i = 0; i < 3 && parents[i].valid(); ++i) {
      const bool known = parents[i]() < before.deformed_slots() || positions.contains(parents[i]);
      ASSERT_TRUE(known) << "a parent that comes later";
      x = x + weights[i] * position(parents[i]);
    }
    positions[vertex] = x;
  }
  for (const auto& [d, x] : positions) EXPECT_TRUE(!after.rest_vertex(d).valid() || x == after.position(d)) << d();
}

/// What the log does not name is unchanged.
void expect_log_complete(const Sheet& before, const Sheet& after) {
  const EditLog& log = after.log();
  std::vector<bool> touched(before.triangle_slots());
  for (const auto& entry : log.touched) {
    EXPECT_FALSE(touched[entry.slot()]) << "logged twice";
    touched[entry.slot()] = true;
    const Triangle& old = before.triangle(entry.slot);
    if (!old.alive()) continue;
    EXPECT_EQ(entry.before.vertex, old.vertex);
    EXPECT_EQ(entry.before.deformed, old.deformed);
    EXPECT_EQ(entry.before.mark, old.mark);
  }
  for (std::size_t t = 0; t < before.triangle_slots(); ++t) {
    if (touched[t]) continue;
    const Triangle &was = before.triangle(TriangleIndex(t)), &is = after.triangle(TriangleIndex(t));
    EXPECT_EQ(was.alive(), is.alive()) << t;
    if (!was.alive() || !is.alive()) continue;
    EXPECT_EQ(was.vertex, is.vertex) << t;
    EXPECT_EQ(was.deformed, is.deformed) << t;
    EXPECT_EQ(was.mark, is.mark) << t;
  }
  std::vector<bool> changed(before.deformed_slots());
  for (const auto& made : log.ancestry)
    if (made.vertex() < changed.size()) changed[made.vertex()] = true;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const DeformedIndex d(i);
    EXPECT_TRUE(changed[i] || !after.rest_vertex(d).valid() || same_bits(before.position(d), after.position(d))) << i;
  }
}

TEST(EditStorm, StaysSoundAndIsLogged) {
  for (std::size_t i = 0; i < scaled(40); ++i) {
    SCOPED_TRACE(i);
    Random random(100 + i);
    Sheet sheet(storm_mesh(i));
    for (int cut = 0; cut < 4; ++cut) {
      sheet.begin_cut();
      const Sheet before = sheet;
      for (int k = 0; k < 25; ++k) {
        edit(sheet, random);
        ASSERT_EQ(faults(sheet, false), "") << "cut " << cut << ", edit " << k;
      }
      open_path(sheet);
      ASSERT_EQ(faults(sheet), "") << "cut " << cut;
      expect_log_complete(before, sheet);
      expect_log_reproduces(before, sheet);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(EditStorm, RollsBackBitExactly) {
  for (std::size_t i = 0; i < scaled(60); ++i) {
    SCOPED_TRACE(i);
    Random random(500 + i);
    Sheet sheet(storm_mesh(i));
    for (int cut = 0; cut < 6; ++cut) {
      sheet.begin_cut();
      const Sheet before = sheet;
      for (int k = 0; k < 30; ++k) edit(sheet, random);
      if (random.coin()) open_path(sheet);
      if (cut % 2 == 1) {  // keep it, and start the next one from a sheet with freed slots
        open_path(sheet);
        continue;
      }
      sheet.rollback();
      ASSERT_EQ(difference(before, sheet), "") << "cut " << cut;
      ASSERT_EQ(faults(sheet), "") << "cut " << cut;
    }
  }
}

/// After a rollback the sheet behaves as if nothing had happened: the same edits give the same slots.
TEST(EditStorm, GoesTheSameWayAgainAfterRollback) {
  for (std::size_t i = 0; i < scaled(40); ++i) {
    SCOPED_TRACE(i);
    Random random(900 + i);
    Sheet sheet(storm_mesh(i));
    for (int cut = 0; cut < 3; ++cut) {
      sheet.begin_cut();
      for (int k = 0; k < 40; ++k) edit(sheet, random);
      open_path(sheet);
    }
    sheet.begin_cut();
    Sheet other = sheet;
    for (int k = 0; k < 20; ++k) edit(sheet, random);
    sheet.rollback();
    sheet.begin_cut();
    other.begin_cut();
    Random again = random, once_more = random;
    for (int k = 0; k < 20; ++k) {
      edit(sheet, again);
      edit(other, once_more);
    }
    ASSERT_EQ(difference(sheet, other), "");
  }
}

TEST(EditStorm, SurvivesCompactionAndTheWayThroughPlainArrays) {
  for (std::size_t i = 0; i < scaled(40); ++i) {
    SCOPED_TRACE(i);
    Random random(1300 + i);
    Sheet sheet(storm_mesh(i));
    for (int cut = 0; cut < 3; ++cut) {
      sheet.begin_cut();
      for (int k = 0; k < 40; ++k) edit(sheet, random);
      open_path(sheet);
    }
    const Sheet before = sheet;
    const Sheet::Compaction map = sheet.compact();
    ASSERT_EQ(faults(sheet), "");
    ASSERT_EQ(sheet.triangle_slots(), before.triangle_count());
    ASSERT_EQ(sheet.vertex_slots(), before.vertex_count());
    ASSERT_EQ(sheet.deformed_slots(), before.deformed_count());
    ASSERT_EQ(map.triangles.size(), before.triangle_slots());
    std::size_t next = 0;
    for (std::size_t t = 0; t < map.triangles.size(); ++t) {
      const Triangle& was = before.triangle(TriangleIndex(t));
      ASSERT_EQ(map.triangles[t].valid(), was.alive());
      if (!was.alive()) continue;
      ASSERT_EQ(map.triangles[t](), next++);
      const Triangle& is = sheet.triangle(map.triangles[t]);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(is.vertex[k], map.vertices[was.vertex[k]()]);
        ASSERT_EQ(is.deformed[k], map.deformed[was.deformed[k]()]);
        ASSERT_EQ(sheet.rest(is.vertex[k]), before.rest(was.vertex[k]));
        ASSERT_EQ(sheet.position(is.deformed[k]), before.position(was.deformed[k]));
        ASSERT_EQ(is.mark[k], was.mark[k]);
      }
    }
    // A mark between two vertices of one fan each opens nothing, so the way through plain arrays loses it, and only it.
    const Sheet again(before.to_mesh_data());
    ASSERT_EQ(faults(again), "");
    EXPECT_EQ(again.deformed_count(), sheet.deformed_count());
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(TriangleIndex(t), k);
        const auto here = to_size(k), end = to_size(next_corner(k));
        const Triangle& triangle = sheet.triangle(TriangleIndex(t));
        ASSERT_EQ(again.triangle(TriangleIndex(t)).deformed, triangle.deformed);
        if (sheet.mark(h) == again.mark(h)) continue;
        const HalfEdge o = sheet.opposite(h);
        const Triangle& beyond = sheet.triangle(triangle_of(o));
        ASSERT_EQ(triangle.deformed[here], beyond.deformed[to_size(next_corner(corner_of(o)))]);
        ASSERT_EQ(triangle.deformed[end], beyond.deformed[to_size(corner_of(o))]);
      }
  }
}

}  // namespace
}  // namespace cutbench
