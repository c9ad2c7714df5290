// The editing calls of the sheet, each followed by check(): what they make, where it goes, and what the log says.

#include "harness/mesh/sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cut/open.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

using NewTriangle = Sheet::NewTriangle;

std::vector<NamedMesh> small_meshes() { return test_meshes(4); }

Point2 on_edge(const Sheet& sheet, HalfEdge h, double lambda) {
  const Point2 a = sheet.rest(sheet.origin(h));
  return a + lambda * (sheet.rest(sheet.target(h)) - a);
}

Point2 centre(const Sheet& sheet, TriangleIndex t) {
  const auto c = sheet.corners(t);
  return 1.0 / 3 * (c[0] + c[1] + c[2]);
}

/// A half-edge that `wanted` likes; invalid where there is none.
template <class Wanted>
HalfEdge find(const Sheet& sheet, Wanted wanted) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3 && sheet.triangle(TriangleIndex(t)).alive(); ++k)
      if (const HalfEdge h = half_edge(TriangleIndex(t), k); wanted(h)) return h;
  return {};
}

HalfEdge inner_edge(const Sheet& sheet) {
  return find(sheet, [&](HalfEdge h) { return !sheet.on_border(h); });
}

/// Opens two edges in a row: the vertex between them gets two fans.
void open_two_edges(Sheet& sheet) {
  const HalfEdge first = find(sheet, [&](HalfEdge h) {
    return !sheet.on_border(h) && !sheet.on_border(sheet.first_outgoing(sheet.target(h)));
  });
  ASSERT_TRUE(first.valid());
  const VertexIndex middle = sheet.target(first);
  HalfEdge second = sheet.first_outgoing(middle);
  for (int i = 0; i < 2 || sheet.target(second) == sheet.origin(first); ++i) second = sheet.next_outgoing(second);
  sheet.set_mark(first, EdgeMark::path);
  sheet.set_mark(second, EdgeMark::path);
  open_path(sheet);
}

TEST(Sheet, SplitsAnEdge) {
  for (const auto& [name, mesh] : small_meshes()) {
    SCOPED_TRACE(name);
    Sheet sheet(lifted(mesh));
    Random random(1);
    const double area = surface_area(sheet);
    for (int i = 0; i < 30; ++i) {
      sheet.begin_cut();
      const HalfEdge h = any_half_edge(sheet, random), o = sheet.opposite(h);
      const TriangleIndex t = triangle_of(h);
      const std::size_t triangles = sheet.triangle_count(), vertices = sheet.vertex_count();
      const double lambda = random.between(0.3, 0.7);
      const Point2 p = on_edge(sheet, h, lambda);
      const VertexIndex a = sheet.origin(h), v = sheet.split_edge(h, lambda, p);
      ASSERT_EQ(faults(sheet), "");
      EXPECT_EQ(sheet.triangle_count(), triangles + (o.valid() ? 2 : 1));
      EXPECT_EQ(sheet.vertex_count(), vertices + 1);
      EXPECT_EQ(sheet.rest(v), p);
      // The first child keeps its parent's slot, and new ones go at the end.
      EXPECT_EQ(sheet.triangle(t).vertex[0], a);
      EXPECT_EQ(sheet.triangle(t).vertex[1], v);
      EXPECT_TRUE(!o.valid() || sheet.triangle(triangle_of(o)).vertex[1] == v);
      EXPECT_EQ(sheet.triangle_slots(), sheet.triangle_count());
    }
    EXPECT_NEAR(surface_area(sheet), area, 1e-12 * area);
  }
}

TEST(Sheet, SplitsATriangle) {
  for (const auto& [name, mesh] : small_meshes()) {
    SCOPED_TRACE(name);
    Sheet sheet(lifted(mesh));
    Random random(2);
    const double area = surface_area(sheet);
    for (int i = 0; i < 30; ++i) {
      sheet.begin_cut();
      const TriangleIndex t = any_triangle(sheet, random);
      const auto corners = sheet.triangle(t).vertex;
      const std::size_t slots = sheet.triangle_slots();
      const VertexIndex v = sheet.split_triangle(t, centre(sheet, t));
      ASSERT_EQ(faults(sheet), "");
      EXPECT_EQ(sheet.triangle_slots(), slots + 2);
      EXPECT_EQ(sheet.triangle(t).vertex, (std::array{corners[0], corners[1], v}));
    }
    EXPECT_NEAR(surface_area(sheet), area, 1e-12 * area);
  }
}

TEST(Sheet, FlipsInnerUnmarkedConvexEdgesOnly) {
  Sheet sheet(make_sheet("delaunay", 5));
  sheet.begin_cut();
  for (std::size_t i = 0; i < 3 * sheet.triangle_slots(); ++i) {
    const HalfEdge h = half_edge(TriangleIndex(i / 3), to_int(i % 3)), o = sheet.opposite(h);
    const Sheet before = sheet;
    const VertexIndex a = sheet.origin(h), b = sheet.target(h);
    bool convex = o.valid();
    if (convex) {
      const Point2 c = sheet.rest(sheet.origin(Sheet::previous(h))), d = sheet.rest(sheet.origin(Sheet::previous(o)));
      convex = orientation(sheet.rest(a), d, c) > 0 && orientation(sheet.rest(b), c, d) > 0;
    }
    EXPECT_EQ(sheet.flip(h), convex);
    ASSERT_EQ(faults(sheet), "");
    EXPECT_TRUE(convex || difference(before, sheet).empty());
    EXPECT_EQ(sheet.triangle_slots(), before.triangle_slots());
  }
  const HalfEdge h = inner_edge(sheet);
  sheet.set_mark(h, EdgeMark::path);
  EXPECT_FALSE(sheet.flip(h));
  EXPECT_FALSE(sheet.flip(sheet.opposite(h)));
}

TEST(Sheet, MovesVerticesWhileTrianglesStayPositive) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  const VertexIndex v(12);  // in the middle
  ASSERT_EQ(sheet.rest(v), (Point2{0.5, 0.5}));
  const Sheet before = sheet;
  EXPECT_FALSE(sheet.move(v, {0.8, 0.5}));
  EXPECT_FALSE(sheet.move(v, {0.75, 0.5}));  // flat
  EXPECT_EQ(difference(before, sheet), "");
  EXPECT_TRUE(sheet.move(v, {0.55, 0.52}));
  EXPECT_EQ(faults(sheet), "");
  EXPECT_EQ(sheet.rest(v), (Point2{0.55, 0.52}));
  ASSERT_EQ(sheet.log().displaced.size(), 1u);
  EXPECT_TRUE(sheet.move(v, {0.45, 0.52}));
  EXPECT_EQ(faults(sheet), "");
  sheet.rollback();
  EXPECT_EQ(difference(before, sheet), "");
}

TEST(Sheet, MovedVertexStaysOnThePlaneOfItsTriangle) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  const VertexIndex v(12);
  const HalfEdge outgoing = sheet.first_outgoing(v);
  const Sheet before = sheet;
  ASSERT_TRUE(sheet.move(v, centre(sheet, triangle_of(outgoing))));
  const auto& corners = before.triangle(triangle_of(outgoing)).deformed;
  const Point3 expected = 1.0 / 3 * before.position(corners[0]) +
                          (1.0 / 3 * before.position(corners[1]) + 1.0 / 3 * before.position(corners[2]));
  const Point3 is = sheet.position(sheet.log().displaced[0].vertex);
  EXPECT_NEAR(is.x, expected.x, 1e-15);
  EXPECT_NEAR(is.y, expected.y, 1e-15);
  EXPECT_NEAR(is.z, expected.z, 1e-15);
}

TEST(Sheet, CollapsesInnerVertices) {
  for (const auto& [name, mesh] : small_meshes()) {
    SCOPED_TRACE(name);
    Sheet sheet(mesh);
    Random random(3);
    int collapsed = 0;
    for (int i = 0; i < 60; ++i) {
      sheet.begin_cut();
      const HalfEdge h = any_half_edge(sheet, random);
      const VertexIndex a = sheet.origin(h);
      const Sheet before = sheet;
      if (sheet.collapse(h)) {
        ++collapsed;
        EXPECT_EQ(sheet.vertex_count() + 1, before.vertex_count());
        EXPECT_EQ(sheet.triangle_count() + 2, before.triangle_count());
        EXPECT_EQ(sheet.deformed_count() + 1, before.deformed_count());
        EXPECT_FALSE(sheet.triangle_of_vertex(a).valid());
      } else {
        EXPECT_EQ(difference(before, sheet), "");
      }
      ASSERT_EQ(faults(sheet), "");
    }
    EXPECT_TRUE(collapsed > 0 || name != "grid4");
  }
}

TEST(Sheet, NeverCollapsesMarkedOrBorderVertices) {
  Sheet sheet(make_sheet("grid", 4));
  sheet.begin_cut();
  open_two_edges(sheet);
  ASSERT_EQ(faults(sheet), "");
  for (std::size_t i = 0; i < 3 * sheet.triangle_slots(); ++i) {
    const HalfEdge h = half_edge(TriangleIndex(i / 3), to_int(i % 3));
    const HalfEdge first = sheet.first_outgoing(sheet.origin(h));
    bool fixed = false;
    HalfEdge outgoing = first;
    do {
      fixed |= sheet.on_border(outgoing) || sheet.mark(outgoing) != EdgeMark::none;
      outgoing = sheet.next_outgoing(outgoing);
    } while (outgoing.valid() && outgoing != first);
    EXPECT_FALSE((fixed || !outgoing.valid()) && sheet.collapse(h));
  }
  EXPECT_EQ(faults(sheet), "");
}

TEST(Sheet, FreedSlotsAreUsedAgainInTheNextCutOnly) {
  Sheet sheet(make_sheet("grid", 4));
  sheet.begin_cut();
  HalfEdge h;
  for (std::size_t i = 0; i < 3 * sheet.triangle_slots() && !h.valid(); ++i)
    if (sheet.collapse(half_edge(TriangleIndex(i / 3), to_int(i % 3)))) h = HalfEdge(i);
  ASSERT_TRUE(h.valid());
  const std::size_t slots = sheet.triangle_slots(), count = sheet.triangle_count(), vertices = sheet.vertex_slots();
  ASSERT_EQ(slots, count + 2);
  sheet.split_triangle(TriangleIndex(sheet.triangle(TriangleIndex(std::size_t{0})).alive() ? 0u : 3u), {});
  sheet.rollback();
  EXPECT_EQ(sheet.triangle_count(), slots);

  sheet.begin_cut();
  for (std::size_t i = 0; i < 3 * sheet.triangle_slots(); ++i)
    if (sheet.collapse(half_edge(TriangleIndex(i / 3), to_int(i % 3)))) break;
  Random random(4);
  TriangleIndex t = any_triangle(sheet, random);
  sheet.split_triangle(t, centre(sheet, t));
  EXPECT_EQ(sheet.triangle_slots(), slots + 2) << "used within the cut that freed it";
  EXPECT_EQ(sheet.vertex_slots(), vertices + 1);
  sheet.begin_cut();
  t = any_triangle(sheet, random);
  sheet.split_triangle(t, centre(sheet, t));
  EXPECT_EQ(sheet.triangle_slots(), slots + 2) << "not used in the next cut";
  EXPECT_EQ(sheet.vertex_slots(), vertices + 1);
  EXPECT_EQ(sheet.triangle_count(), sheet.triangle_slots());
  EXPECT_EQ(sheet.deformed_count(), sheet.deformed_slots());
  EXPECT_EQ(faults(sheet), "");
}

TEST(Sheet, SplittingAnIncisionMakesADeformedVertexOnEachSide) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  open_two_edges(sheet);
  for (std::size_t d = 0; d < sheet.deformed_slots(); d += 2) {  // pull everything apart
    const DeformedIndex i(d);
    sheet.set_position(i, sheet.position(i) + Point3{0, 0, 0.1 * to_double(d % 7)});
  }
  const double area = surface_area(sheet);
  sheet.begin_cut();
  const HalfEdge h = find(sheet, [&](HalfEdge e) { return sheet.mark(e) == EdgeMark::incision; });
  ASSERT_TRUE(h.valid());
  const std::size_t deformed = sheet.deformed_count();
  sheet.split_edge(h, 0.4, on_edge(sheet, h, 0.4));
  EXPECT_EQ(faults(sheet), "");
  EXPECT_EQ(sheet.deformed_count(), deformed + 2);
  EXPECT_NEAR(surface_area(sheet), area, 1e-12 * area);
}

/// An edge that bounds the cavity keeps its mark, whatever the caller says, and whether its triangle has a parent or
/// not.
TEST(Sheet, ReplacedCavityKeepsTheMarksRoundIt) {
  for (int parent : {-1, 0})
    for (int turn = 0; turn < 3; ++turn) {
      Sheet sheet(make_sheet("grid", 4));
      sheet.begin_cut();
      open_two_edges(sheet);
      sheet.begin_cut();
      const HalfEdge h = find(sheet, [&](HalfEdge e) { return sheet.mark(e) == EdgeMark::incision; });
      auto v = sheet.triangle(triangle_of(h)).vertex;
      std::rotate(v.begin(), v.begin() + turn, v.end());
      const NewTriangle same[] = {{v, parent, {}}};
      sheet.replace_cavity(std::array{triangle_of(h)}, same);
      EXPECT_EQ(faults(sheet), "") << parent << " " << turn;
    }
}

/// Old and new triangles of both fans at a vertex on an incision, and no parents given.
TEST(Sheet, ReplacedFansFindTheirDeformedVertices) {
  Sheet sheet(make_sheet("grid", 4));
  sheet.begin_cut();
  open_two_edges(sheet);
  sheet.begin_cut();
  const Sheet before = sheet;
  std::vector<TriangleIndex> all;
  std::vector<NewTriangle> same;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    all.emplace_back(t);
    same.push_back({{triangle.vertex[1], triangle.vertex[2], triangle.vertex[0]},
                    -1,
                    {triangle.mark[1], triangle.mark[2], triangle.mark[0]}});
  }
  sheet.replace_cavity(all, same);
  ASSERT_EQ(faults(sheet), "");
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(sheet.triangle(TriangleIndex(t)).deformed[k], before.triangle(TriangleIndex(t)).deformed[(k + 1) % 3]);
}

/// A triangle that was cut free and lifted, all three sides divided at once, and no parents given.
TEST(Sheet, NewVerticesOnIncisionsFindTheirSide) {
  Sheet sheet(make_sheet("grid", 4));
  sheet.begin_cut();
  const TriangleIndex free = triangle_of(find(sheet, [&](HalfEdge h) {
    return !sheet.on_border(h) && !sheet.on_border(Sheet::next(h)) && !sheet.on_border(Sheet::previous(h));
  }));
  for (int k = 0; k < 3; ++k) sheet.set_mark(half_edge(free, k), EdgeMark::path);
  open_path(sheet);
  for (const DeformedIndex d : sheet.triangle(free).deformed)
    sheet.set_position(d, sheet.position(d) + Point3{0, 0, 1});

  sheet.begin_cut();
  constexpr EdgeMark none = EdgeMark::none, open = EdgeMark::incision;
  const auto v = sheet.triangle(free).vertex;
  std::vector<TriangleIndex> removed{free};
  std::vector<NewTriangle> added;
  std::array<VertexIndex, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(free, to_int(k)), o = sheet.opposite(h);
    m[k] = sheet.new_vertex(k == 0 ? h : o, 0.5, on_edge(sheet, h, 0.5));
    const VertexIndex apex = sheet.origin(Sheet::previous(o));
    removed.push_back(triangle_of(o));
    added.push_back({{v[(k + 1) % 3], m[k], apex}, -1, {open, none, none}});
    added.push_back({{m[k], v[k], apex}, -1, {open, none, none}});
  }
  for (std::size_t k = 0; k < 3; ++k) added.push_back({{v[k], m[k], m[(k + 2) % 3]}, -1, {open, none, open}});
  added.push_back({m, -1, {}});
  sheet.replace_cavity(removed, added);
  ASSERT_EQ(faults(sheet), "");
  std::size_t lifted = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const auto& d = sheet.triangle(TriangleIndex(t)).deformed;
    const auto is_up = [&](DeformedIndex i) { return sheet.position(i).z == 1; };
    EXPECT_EQ(is_up(d[0]), is_up(d[1])) << t;
    EXPECT_EQ(is_up(d[1]), is_up(d[2])) << t;
    lifted += is_up(d[0]);
  }
  EXPECT_EQ(lifted, 4u);
}

TEST(Sheet, MarksBothHalfEdgesAndNothingOnTheBorder) {
  Sheet sheet(make_sheet("alternating", 3));
  sheet.begin_cut();
  const HalfEdge border = find(sheet, [&](HalfEdge h) { return sheet.on_border(h); });
  const Sheet before = sheet;
  sheet.set_mark(border, EdgeMark::path);
  EXPECT_EQ(difference(before, sheet), "");
  const HalfEdge inner = inner_edge(sheet);
  sheet.set_mark(inner, EdgeMark::path);
  EXPECT_EQ(sheet.mark(inner), EdgeMark::path);
  EXPECT_EQ(sheet.mark(sheet.opposite(inner)), EdgeMark::path);
  EXPECT_EQ(sheet.log().path_vertices.size(), 2u);
  EXPECT_EQ(faults(sheet, false), "");
  EXPECT_NE(faults(sheet, true), "");
}

/// Fans round all vertices, counted by rest position: what is left of a vertex in several fans became several vertices.
std::size_t count_fans(const Sheet& sheet) {
  std::map<std::array<double, 2>, std::vector<std::array<double, 4>>> wedges;  // per place: sides of its corners
  std::size_t fans = 0;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    if (!sheet.triangle(TriangleIndex(i)).alive()) continue;
    const auto c = sheet.corners(TriangleIndex(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      wedges[{c[k].x, c[k].y}].push_back({a.x, a.y, b.x, b.y});
    }
  }
  for (const auto& [place, all] : wedges) {
    std::size_t joints = 0;
    for (const auto& w : all)
      for (const auto& other : all) joints += w[2] == other[0] && w[3] == other[1];
    fans += std::max<std::size_t>(all.size() - joints, 1);  // a closed one has as many joints as corners
  }
  return fans;
}

TEST(Sheet, RemovesTriangles) {
  for (const auto& [name, mesh] : small_meshes()) {
    SCOPED_TRACE(name);
    Random random(7);
    for (int trial = 0; trial < 40; ++trial) {
      Sheet sheet(lifted(mesh));
      for (int call = 0; call < 3 && sheet.triangle_count() > 4; ++call) {
        sheet.begin_cut();
        const Sheet before = sheet;
        std::set<TriangleIndex> chosen;
        for (std::size_t i = 0; i < 1 + random.below(sheet.triangle_count() / 3); ++i)
          chosen.insert(any_triangle(sheet, random));
        const std::vector<TriangleIndex> removed(chosen.begin(), chosen.end());
        sheet.remove(removed);
        ASSERT_EQ(faults(sheet), "");
        ASSERT_EQ(sheet.triangle_count(), before.triangle_count() - removed.size());
        ASSERT_EQ(sheet.vertex_count(), count_fans(sheet));
        ASSERT_EQ(sheet.deformed_count(), sheet.vertex_count());
        for (std::size_t t = 0; t < before.triangle_slots(); ++t) {
          const bool stays = before.triangle(TriangleIndex(t)).alive() && !chosen.contains(TriangleIndex(t));
          ASSERT_EQ(sheet.triangle(TriangleIndex(t)).alive(), stays);
          for (std::size_t k = 0; k < 3 && stays; ++k) {
            const auto now = sheet.triangle(TriangleIndex(t)).deformed[k];
            ASSERT_EQ(sheet.position(now), before.position(before.triangle(TriangleIndex(t)).deformed[k]));
          }
        }
        if (random.coin()) {
          sheet.rollback();
          ASSERT_EQ(difference(before, sheet), "");
        }
      }
    }
  }
}

/// At its tips, where the two lips come apart, as well as along it.
TEST(Sheet, RemovesAnyTriangleNearAnIncision) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  open_two_edges(sheet);
  const std::size_t pieces = count_pieces(sheet);
  std::size_t more = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    sheet.begin_cut();
    const Sheet before = sheet;
    const TriangleIndex one[] = {TriangleIndex(t)};
    sheet.remove(one);
    ASSERT_EQ(faults(sheet), "") << t;
    EXPECT_LE(count_pieces(sheet), pieces + 1);
    more += sheet.deformed_count() > before.deformed_count();
    sheet.rollback();
    ASSERT_EQ(difference(before, sheet), "") << t;
  }
  EXPECT_GT(more, 0u) << "no lips have come apart";
}

TEST(Sheet, RemovesTrianglesBesideAnIncision) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  open_two_edges(sheet);
  const HalfEdge lip = find(sheet, [&](HalfEdge h) { return sheet.mark(h) == EdgeMark::incision; });
  sheet.begin_cut();
  const Sheet before = sheet;
  const TriangleIndex one[] = {triangle_of(lip)}, other[] = {triangle_of(sheet.opposite(lip))};
  const HalfEdge far = sheet.opposite(lip);
  sheet.remove(one);
  ASSERT_EQ(faults(sheet), "");
  EXPECT_TRUE(sheet.on_border(far));
  EXPECT_EQ(sheet.mark(far), EdgeMark::none);
  sheet.remove(other);
  ASSERT_EQ(faults(sheet), "");
  sheet.rollback();
  EXPECT_EQ(difference(before, sheet), "");
}

TEST(Sheet, WeldsTheLipsOfIncisions) {
  Sheet sheet(lifted(make_sheet("grid", 4)));
  sheet.begin_cut();
  open_two_edges(sheet);
  for (std::size_t d = 0; d < sheet.deformed_slots(); d += 2)
    sheet.set_position(DeformedIndex(d), {to_double(d), 0, 1});
  MeshData mesh = sheet.to_mesh_data();
  const Sheet again(mesh);
  EXPECT_EQ(faults(again), "");
  EXPECT_EQ(again.vertex_count(), sheet.vertex_count());
  EXPECT_EQ(again.deformed_count(), sheet.deformed_count());
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    EXPECT_EQ(again.triangle(TriangleIndex(t)).mark, sheet.triangle(TriangleIndex(t)).mark);
    EXPECT_EQ(again.triangle(TriangleIndex(t)).opposite, sheet.triangle(TriangleIndex(t)).opposite);
    EXPECT_EQ(again.triangle(TriangleIndex(t)).deformed, sheet.triangle(TriangleIndex(t)).deformed);
  }
  EXPECT_EQ(count_pieces(again), count_pieces(sheet));
}

/// A vertex with a triangle of hardly any height beside it moves onto the far edge of that: in an undeformed sheet
/// deformed positions stay rest positions.
TEST(Sheet, MovesInThinTrianglesKeepTheUndeformedSheet) {
  for (const double height : {1e-3, 1e-6, 6e-12, 3e-14, 1e-16})
    for (const double at : {0.31, 0.5, 0.77}) {
      MeshData mesh{{{0.1, 0.2}, {0.9, 0.4}, {0.4, 0.9}, {0.3, -0.4}, {0, 0}}, {}, {}, {}, {}};
      const Point2 a = mesh.rest[0], b = mesh.rest[1], along = b - a;
      mesh.rest[4] = a + at * along + height * Point2{-along.y, along.x};
      mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {1, 0, 3}};
      for (const Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
      bool sound = true;
      for (const auto& t : mesh.triangles)
        sound &= orientation(mesh.rest[to_size(t[0])], mesh.rest[to_size(t[1])], mesh.rest[to_size(t[2])]) > 0;
      if (!sound) continue;
      Sheet sheet(mesh);
      sheet.begin_cut();
      const Point2 to = mesh.rest[4] + 0.37 * height * Point2{along.x, along.y};
      const bool moved = sheet.move(VertexIndex(4), to);
      const Point2 p = sheet.rest(VertexIndex(4));
      const Point3 x = sheet.position(DeformedIndex(4));
      EXPECT_NEAR(x.x, p.x, 1e-15) << height << ' ' << at << ' ' << moved;
      EXPECT_NEAR(x.y, p.y, 1e-15) << height << ' ' << at << ' ' << moved;
    }
}

}  // namespace
}  // namespace cutbench
