// Triangle by triangle: the short cuts of the methods against the general routines, and those against first principles.

#include "harness/cut/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/predicates.h"
#include "harness/path/trace.h"
#include "methods/bowyer_watson/bowyer_watson.h"
#include "methods/tools/static_split.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

using Triangles = std::set<std::array<VertexIndex, 3>>;

/// Each triangle from its smallest vertex on.
std::array<VertexIndex, 3> turned(std::array<VertexIndex, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}
Triangles triangles_of(const Patch& patch) {
  Triangles all;
  for (const auto& [a, b, c] : patch.triangles) {
    const auto vertex = [&](int p) { return patch.vertices[to_size(p)]; };
    all.insert(turned({vertex(a), vertex(b), vertex(c)}));
  }
  return all;
}
/// What split_crossing() makes: the corner keeps the slot, the two others are new.
Triangles triangles_after(Sheet& sheet, const Crossing& crossing, bool diagonal_from_p) {
  split_crossing(sheet, crossing, diagonal_from_p);
  Triangles all;
  const std::size_t n = sheet.triangle_slots();
  for (std::size_t t : {triangle_of(crossing.edge)(), n - 2, n - 1})
    all.insert(turned(sheet.triangle(TriangleIndex(t)).vertex));
  return all;
}

Point2 at(const Patch& patch, int p) { return patch.points[to_size(p)]; }

/// Positive triangles, as many as it takes to fill the ring, and every segment an edge.
void expect_answer(const Patch& patch) {
  EXPECT_EQ(patch.triangles.size(), patch.ring.size() - 2 + 2 * patch.inside_count());
  double area = 0;
  for (const auto& [a, b, c] : patch.triangles) {
    EXPECT_EQ(orientation(at(patch, a), at(patch, b), at(patch, c)), 1);
    area += cross(at(patch, b) - at(patch, a), at(patch, c) - at(patch, a));
  }
  const double whole = cross(at(patch, 1) - at(patch, 0), at(patch, 2) - at(patch, 0));
  EXPECT_NEAR(area, whole, 1e-9 * whole);
  for (const auto& [a, b] : patch.segments)
    EXPECT_TRUE(find_edge(patch, a, b).triangle >= 0 || find_edge(patch, b, a).triangle >= 0);
}

/// The patches that cuts of all families make; visit(sheet, subdivision, face, patch), which may split it. All is
/// undone in the end.
template <class Visit>
void for_patches(std::uint64_t seed, Visit visit) {
  for (const auto& [name, mesh] : test_meshes(5))
    for (const std::string family : cut_families())
      for (std::size_t i = 0; i < scaled(10); ++i) {
        SCOPED_TRACE(name + ", " + family + " " + std::to_string(i));
        Sheet sheet(mesh);
        const Locator locator(sheet);
        Polyline line;
        flatten(make_case(family, seed, i, sheet).front(), 1e-3 * sheet.mean_edge(), sheet.snap(), line);
        Walk walk(sheet, locator);
        walk.locate(line.points.front());
        Tracer tracer;
        Subdivision& trace = tracer.trace(sheet, line, walk, i % 2 == 0 ? infinite : 0.05 * sheet.mean_edge());
        sheet.begin_cut();
        make_vertices(sheet, trace);
        Patch patch;
        for (int f = 0; f < to_int(trace.faces.size()); ++f) {
          make_patch(sheet, trace, f, patch);
          visit(sheet, trace, f, patch);
        }
        sheet.rollback();
        expect_bit_equal(sheet.to_mesh_data(), Sheet(mesh).to_mesh_data());
        ASSERT_EQ(faults(sheet), "");
      }
}

TEST(Patch, IsWellFormed) {
  for_patches(21, [](Sheet& sheet, const Subdivision&, int, const Patch& patch) {
    ASSERT_EQ(patch.ring.front(), 0);
    ASSERT_EQ(patch.ring.size(), patch.ring_marks.size());
    for (std::size_t i = 0; i < patch.ring.size(); ++i) {
      const int p = patch.ring[i], q = patch.ring[(i + 1) % patch.ring.size()];
      EXPECT_EQ(patch.ring_position[to_size(p)], to_int(i));
      const int k = patch.edge_of(p);
      const Point2 along = at(patch, next_corner(k)) - at(patch, k);
      EXPECT_GT(dot(at(patch, q) - at(patch, p), along), 0) << "not in order";
      EXPECT_NEAR(cross(along, at(patch, p) - at(patch, k)) / dot(along, along), 0, 1e-10);
    }
    for (std::size_t p = 0; p < patch.points.size(); ++p) EXPECT_EQ(patch.points[p], sheet.rest(patch.vertices[p]));
    EXPECT_EQ(patch.path_order.size(), patch.points.size() - 3);
  });
}

TEST(Patch, ConventionalShortCutsGiveTheSameTriangles) {
  std::size_t crossings = 0, patches = 0;
  for_patches(22, [&](Sheet& sheet, const Subdivision& trace, int f, Patch& patch) {
    Patch other = patch;
    split_conventionally(patch);
    split_step_by_step(other);
    expect_answer(patch);
    expect_answer(other);
    EXPECT_EQ(triangles_of(patch), triangles_of(other));
    ++patches;
    Crossing crossing;
    if (!find_crossing(sheet, trace, f, crossing)) return;
    EXPECT_EQ(triangles_after(sheet, crossing, crossing.p_first), triangles_of(other));
    ++crossings;
  });
  EXPECT_GT(crossings, patches / 4);
}

TEST(Patch, TheDelaunayDiagonalIsThatOfTheGeneralRoutine) {
  std::size_t crossings = 0;
  for_patches(23, [&](Sheet& sheet, const Subdivision& trace, int f, Patch& patch) {
    Crossing crossing;
    if (!find_crossing(sheet, trace, f, crossing)) return;
    EXPECT_EQ(triangulate_delaunay(patch), 0) << "two crossings: the path is always contained";
    expect_answer(patch);
    EXPECT_EQ(triangles_after(sheet, crossing, is_diagonal_from_p_delaunay(crossing)), triangles_of(patch));
    ++crossings;
  });
  EXPECT_GT(crossings, 100u);
}

/// Random points inside and on the edges of one triangle, where they are exactly on them.
Patch random_patch(Sheet& sheet, Subdivision& subdivision, Random& random, std::size_t points) {
  subdivision.reset(sheet);
  while (subdivision.nodes.size() < points) {
    const double unit = to_double(1 + random.below((1 << 10) - 1)) * 0x1p-10;
    Place place;
    if (random.coin(0.4)) {
      place.kind = Place::Kind::edge;
      place.edge = half_edge(TriangleIndex(std::size_t{0}), to_int(random.below(3)));
      const Point2 a = sheet.rest(sheet.origin(place.edge));
      place.lambda = unit;
      place.point = a + unit * (sheet.rest(sheet.target(place.edge)) - a);
    } else {
      place = place_in(TriangleIndex(std::size_t{0}), {unit, to_double(random.below(1 << 10)) * 0x1p-10});
      if (place.point.x + place.point.y >= 1 || place.point.y == 0) continue;
    }
    subdivision.node_of(place);
  }
  sheet.begin_cut();
  make_vertices(sheet, subdivision);
  Patch patch;
  make_patch(sheet, subdivision, 0, patch);
  return patch;
}

MeshData one_triangle() { return {{{0, 0}, {1, 0}, {0, 1}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}, {}}; }

TEST(Patch, DelaunayHasNoPointInsideACircle) {
  Random random(24);
  for (std::size_t i = 0; i < scaled(500); ++i) {
    Sheet sheet(one_triangle());
    Subdivision subdivision;
    Patch patch = random_patch(sheet, subdivision, random, 1 + i % 12);
    EXPECT_EQ(triangulate_delaunay(patch), 0);
    expect_answer(patch);
    for (const auto& [a, b, c] : patch.triangles)
      for (Point2 p : patch.points) EXPECT_LE(in_circle(at(patch, a), at(patch, b), at(patch, c), p), 0) << i;
  }
}

TEST(Patch, RecoversSegmentsAndCountsThem) {
  Random random(25);
  std::size_t recovered = 0;
  for (std::size_t i = 0; i < scaled(500); ++i) {
    Sheet sheet(one_triangle());
    Subdivision subdivision;
    Patch patch = random_patch(sheet, subdivision, random, 4 + i % 10);
    // Segments that cross no other and pass through no point, as many as are found.
    const int n = to_int(patch.points.size());
    for (int tries = 0; tries < 20; ++tries) {
      const auto any = [&] { return to_int(random.below(to_size(n))); };
      const int a = any(), b = any();
      const auto on_one_edge = [&](int p, int q) {
        for (int k = 0; k < 3; ++k)
          if (orientation(at(patch, k), at(patch, next_corner(k)), at(patch, p)) == 0 &&
              orientation(at(patch, k), at(patch, next_corner(k)), at(patch, q)) == 0)
            return true;
        return false;
      };
      bool clear = a != b && !on_one_edge(a, b);
      for (int p = 0; p < n && clear; ++p)
        clear = p == a || p == b || orientation(at(patch, a), at(patch, b), at(patch, p)) != 0;
      for (const auto& [c, d] : patch.segments)
        clear = clear && !((a == c && b == d) || (a == d && b == c)) &&
                (a == c || a == d || b == c || b == d ||
                 orientation(at(patch, a), at(patch, b), at(patch, c)) ==
                     orientation(at(patch, a), at(patch, b), at(patch, d)) ||
                 orientation(at(patch, c), at(patch, d), at(patch, a)) ==
                     orientation(at(patch, c), at(patch, d), at(patch, b)));
      if (clear) patch.segments.push_back({a, b});
    }
    Patch without = patch, step_by_step = patch;
    without.segments.clear();
    triangulate_delaunay(without);
    int missing = 0;
    for (const auto& [a, b] : patch.segments)
      missing += find_edge(without, a, b).triangle < 0 && find_edge(without, b, a).triangle < 0;
    const int count = triangulate_delaunay(patch);
    expect_answer(patch);
    EXPECT_EQ(count > 0, missing > 0) << i;
    EXPECT_TRUE(patch.segments.size() != 1 || count == missing) << i;
    recovered += to_size(count);
    split_step_by_step(step_by_step);
    expect_answer(step_by_step);
  }
  EXPECT_GT(recovered, scaled(500) / 2);
}

}  // namespace
}  // namespace cutbench
