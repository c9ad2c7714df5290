// Traces held against a brute-force intersection in exact rationals, and the cases that walks get lost in.

#include "harness/path/trace.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/tolerances.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// A sheet and what it takes to trace on it.
struct Bench {
  explicit Bench(const MeshData& mesh) : sheet(mesh), locator(sheet) {}

  Subdivision& trace(const Curve& curve, double chord_tolerance = infinite) {
    flatten(curve, 1e-3 * sheet.mean_edge(), sheet.snap(), line);
    Walk walk(sheet, locator);
    walk.locate(line.points.front());
    return tracer.trace(sheet, line, walk, chord_tolerance * sheet.mean_edge());
  }
  Subdivision& trace(std::vector<Point2> points, bool closed = false, double chord_tolerance = infinite) {
    return trace({Curve::Kind::polyline, closed, std::move(points)}, chord_tolerance);
  }

  Sheet sheet;
  Locator locator;
  Tracer tracer;
  Polyline line;
};

std::size_t count(const Subdivision& trace, Place::Kind kind) {
  return to_size(
      std::count_if(trace.nodes.begin(), trace.nodes.end(), [&](const auto& node) { return node.place.kind == kind; }));
}

std::size_t live_segments(const Subdivision& trace) {
  std::size_t n = 0;
  for (const auto& face : trace.faces)
    for (int s = face.segments; s >= 0; s = trace.segment(s).next) ++n;
  return n;
}

/// Segments lie inside their triangle, join nodes of it, and meet in nodes only; nodes on edges are in order.
void expect_sound(const Bench& bench, const Subdivision& trace) {
  const Sheet& sheet = bench.sheet;
  for (const auto& face : trace.faces) {
    std::vector<std::array<Point2, 2>> segments;
    for (int s = face.segments; s >= 0; s = trace.segment(s).next) {
      const auto &from = trace.node(trace.segment(s).from), &to = trace.node(trace.segment(s).to);
      EXPECT_NE(trace.segment(s).from, trace.segment(s).to);
      segments.push_back({from.place.point, to.place.point});
      for (const auto& node : {from, to}) {
        const auto corners = sheet.triangle(face.triangle).vertex;
        const Place& at = node.place;
        const HalfEdge o = at.kind == Place::Kind::edge ? sheet.opposite(at.edge) : HalfEdge();
        EXPECT_TRUE(
            (at.kind == Place::Kind::face && at.face == face.triangle) ||
            (at.kind == Place::Kind::vertex && std::find(corners.begin(), corners.end(), at.vertex) != corners.end()) ||
            (at.kind == Place::Kind::edge &&
             (triangle_of(at.edge) == face.triangle || (o.valid() && triangle_of(o) == face.triangle))));
      }
    }
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto [a, b] = segments[i];
        const auto [c, d] = segments[j];
        const bool apart =
            orientation(a, b, c) * orientation(a, b, d) > 0 || orientation(c, d, a) * orientation(c, d, b) > 0;
        EXPECT_TRUE(apart || a == c || a == d || b == c || b == d ||
                    std::min({std::abs(cross(b - a, c - a)), std::abs(cross(b - a, d - a)),
                              std::abs(cross(d - c, a - c)), std::abs(cross(d - c, b - c))}) <
                        1e-9 * sheet.mean_edge() * sheet.mean_edge());
      }
    for (int head : face.on_edge)
      for (int n = head; n >= 0 && trace.node(n).next >= 0; n = trace.node(n).next)
        EXPECT_LT(trace.node(n).place.lambda, trace.node(trace.node(n).next).place.lambda);
  }
}

struct Rational {
  mpq_class x, y;
  explicit Rational(Point2 p) : x(p.x), y(p.y) {}
};
int sign(const Rational& a, const Rational& b, const Rational& c) {
  return sgn((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

TEST(Trace, MeetsTheEdgesThatExactIntersectionFinds) {
  for (const auto& [name, mesh] : test_meshes(5)) {
    SCOPED_TRACE(name);
    Bench bench(mesh);
    const Sheet& sheet = bench.sheet;
    const SheetExtent extent = extent_of(sheet);
    Random random(11);
    for (std::size_t i = 0; i < scaled(40); ++i) {
      const auto point = [&] {
        return Point2{random.between(extent.low.x - 0.2, extent.high.x + 0.2),
                      random.between(extent.low.y - 0.2, extent.high.y + 0.2)};
      };
      const Point2 a = point(), b = point();
      std::map<HalfEdge, Point2> expected;
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
        for (int k = 0; k < 3; ++k) {
          const HalfEdge h = half_edge(TriangleIndex(t), k);
          if (first_half_edge(sheet, h) != h) continue;
          const Rational p(a), q(b), u(sheet.rest(sheet.origin(h))), v(sheet.rest(sheet.target(h)));
          if (sign(p, q, u) * sign(p, q, v) >= 0 || sign(u, v, p) * sign(u, v, q) >= 0) continue;
          const mpq_class from = (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
          const mpq_class to = (v.x - u.x) * (q.y - u.y) - (v.y - u.y) * (q.x - u.x);
          const mpq_class s = from / (from - to), x = p.x + s * (q.x - p.x), y = p.y + s * (q.y - p.y);
          expected[h] = {x.get_d(), y.get_d()};
        }
      const Subdivision& trace = bench.trace({a, b});
      std::size_t met = 0;
      for (const auto& node : trace.nodes) {
        if (node.place.kind != Place::Kind::edge) continue;
        ++met;
        ASSERT_TRUE(expected.contains(node.place.edge)) << i;
        EXPECT_LT(std::sqrt(squared_length(expected[node.place.edge] - node.place.point)), 1e-12 * sheet.size()) << i;
      }
      // A cut that crosses nothing twice may lie in one triangle: then it has one more node, inside.
      EXPECT_EQ(met, expected.size()) << i;
      EXPECT_EQ(count(trace, Place::Kind::vertex), 0u) << i;
      expect_sound(bench, trace);
    }
  }
}

/// Through vertices by way of an exact orientation: what lies within the snap distance is met, nothing else.
TEST(Trace, EveryFamilyGivesSoundTraces) {
  for (const auto& [name, mesh] : test_meshes(5))
    for (const std::string family : cut_families())
      for (std::size_t i = 0; i < scaled(20); ++i) {
        SCOPED_TRACE(name + ", " + family + " " + std::to_string(i));
        Bench bench(mesh);
        for (const Curve& curve : make_case(family, 12, i, bench.sheet))
          for (double chord : {0.05, infinite}) {
            const Subdivision& trace = bench.trace(curve, chord);
            expect_sound(bench, trace);
            for (const auto& node : trace.nodes) {  // every node lies on the polyline
              double nearest = 1e300;
              const std::size_t n = bench.line.points.size();
              for (std::size_t k = 0; k + (curve.closed ? 0 : 1) < n; ++k) {
                const Point2 a = bench.line.points[k], ab = bench.line.points[(k + 1) % n] - a, p = node.place.point;
                const double s = std::clamp(dot(p - a, ab) / squared_length(ab), 0.0, 1.0);
                nearest = std::min(nearest, std::sqrt(squared_length(p - (a + s * ab))));
              }
              EXPECT_LE(nearest, meeting_tolerance * bench.sheet.snap());
            }
          }
      }
}

TEST(Trace, ThroughVerticesAndAlongEdges) {
  Bench bench(make_sheet("grid", 4));
  Subdivision* trace = &bench.trace({{-1, -1}, {2, 2}});  // all diagonals
  EXPECT_EQ(trace->nodes.size(), 5u);
  EXPECT_EQ(count(*trace, Place::Kind::vertex), 5u);
  EXPECT_EQ(trace->along.size(), 4u);
  EXPECT_EQ(live_segments(*trace), 0u);
  EXPECT_EQ(trace->crossed_triangles(), 0u);
  trace = &bench.trace({{0, 1}, {1, 0}});  // across the diagonals
  EXPECT_EQ(count(*trace, Place::Kind::vertex), 5u);
  EXPECT_EQ(count(*trace, Place::Kind::edge), 4u);
  EXPECT_EQ(trace->crossed_triangles(), 8u);
  trace = &bench.trace({{0.25, 0.3}, {0.25, 0.7}});  // along a column, ends inside edges
  EXPECT_EQ(count(*trace, Place::Kind::edge), 2u);
  EXPECT_EQ(count(*trace, Place::Kind::vertex), 1u);
  EXPECT_EQ(trace->along.size(), 2u);
  trace = &bench.trace({{0.25, 0.5}, {0.5, 0.5}, {0.5, 0.75}, {0.25, 0.5}});  // round one triangle
  EXPECT_EQ(trace->nodes.size(), 3u);
  EXPECT_EQ(trace->along.size(), 3u);
}

TEST(Trace, OutAndBackIn) {
  Bench bench(make_sheet("grid", 4));
  EXPECT_TRUE(bench.trace({{-1, -1}, {2, -0.5}}).nodes.empty());
  EXPECT_TRUE(bench.trace({{-1, 0}, {2, 0}}).along.empty());              // along the border: open already
  EXPECT_TRUE(bench.trace({{-0.5, 0.5}, {0.5, -0.5}}).segments.empty());  // touches a corner
  const Subdivision& trace = bench.trace({{0.1, 0.05}, {0.2, -0.3}, {0.3, 0.05}});
  std::size_t on_border = 0;
  for (const auto& node : trace.nodes)
    on_border += node.place.kind == Place::Kind::edge && bench.sheet.on_border(node.place.edge);
  EXPECT_EQ(on_border, 2u);
  EXPECT_EQ(live_segments(trace), 2u);
  expect_sound(bench, trace);
}

TEST(Trace, TipsOnEdgesVerticesAndTheBorder) {
  Bench bench(make_sheet("grid", 4));
  for (const auto& [tip, kind] :
       {std::pair{Point2{0.5, 0.5}, Place::Kind::vertex},
        std::pair{Point2{0.5 + 1e-13, 0.5 - 1e-13}, Place::Kind::vertex},
        std::pair{Point2{0.5, 0.6}, Place::Kind::edge}, std::pair{Point2{0.5 + 1e-13, 0.6}, Place::Kind::edge},
        std::pair{Point2{0.6, 0.6}, Place::Kind::edge}, std::pair{Point2{0.55, 0.6}, Place::Kind::face}})
    for (bool reversed : {false, true}) {
      std::vector<Point2> points{{-0.1, 0.41}, tip};
      if (reversed) std::swap(points[0], points[1]);
      const Subdivision& trace = bench.trace(points);
      ASSERT_FALSE(trace.nodes.empty());
      const Place& place = (reversed ? trace.nodes.front() : trace.nodes.back()).place;
      EXPECT_EQ(place.kind, kind) << tip.x << " " << tip.y;
      EXPECT_LT(std::abs(place.point.x - tip.x) + std::abs(place.point.y - tip.y), 1e-11);
      expect_sound(bench, trace);
    }
}

TEST(Trace, KeepsLoopsAndUTurnsInsideOneTriangle) {
  Bench bench(make_sheet("grid", 4));
  // A round loop: its start is no corner, and still three nodes or more are kept.
  const Curve loop{Curve::Kind::bezier,
                   true,
                   {{0.42, 0.33}, {0.42, 0.37}, {0.36, 0.37}, {0.36, 0.33}, {0.36, 0.29}, {0.42, 0.29}, {0.42, 0.33}}};
  const Subdivision* trace = &bench.trace(loop);
  EXPECT_GE(trace->nodes.size(), 3u);
  EXPECT_EQ(live_segments(*trace), trace->nodes.size());
  EXPECT_EQ(trace->faces.size(), 1u);
  // A round U-turn that comes out of the edge it went in by.
  const Curve turn{Curve::Kind::bezier, false, {{0.3, -0.1}, {0.3, 0.5}, {0.35, 0.5}, {0.35, -0.1}}};
  trace = &bench.trace(turn);
  EXPECT_GE(count(*trace, Place::Kind::face) + count(*trace, Place::Kind::edge), 5u);
  expect_sound(bench, *trace);
  // A slit between two tips gets a vertex in the middle, else nothing could open.
  trace = &bench.trace({{0.3, 0.27}, {0.4, 0.3}});
  EXPECT_EQ(trace->nodes.size(), 3u);
  EXPECT_EQ(live_segments(*trace), 2u);
  trace = &bench.trace({{0.25, 0.25}, {0.5, 0.25}});
  EXPECT_EQ(trace->nodes.size(), 3u);
  // A figure eight inside one triangle crosses itself in a node.
  trace = &bench.trace({{0.32, 0.27}, {0.42, 0.32}, {0.42, 0.27}, {0.32, 0.32}}, true);
  EXPECT_EQ(trace->nodes.size(), 5u);
  EXPECT_EQ(live_segments(*trace), 6u);
}

TEST(Trace, ChordToleranceDecidesWhichCurvePointsStay) {
  Bench bench(make_sheet("grid", 4));
  const Curve curve{Curve::Kind::bezier, false, {{-0.1, 0.3}, {0.4, 0.9}, {0.6, 0.1}, {1.1, 0.6}}};
  std::size_t before = 0;
  for (double chord : {infinite, 0.05, 0.02, 0.005}) {
    const Subdivision& trace = bench.trace(curve, chord);
    EXPECT_GE(count(trace, Place::Kind::face), before);
    before = count(trace, Place::Kind::face);
    EXPECT_TRUE(std::isfinite(chord) || before == 0);
    const double h = bench.sheet.mean_edge();
    for (Point2 p : bench.line.points) {  // no point of the polyline is farther from the segments than the tolerance
      if (std::isinf(chord) || p.x <= 0 || p.x >= 1 || p.y <= 0 || p.y >= 1) continue;
      double nearest = 1e300;
      for (const auto& s : trace.segments) {
        const Point2 a = trace.node(s.from).place.point, ab = trace.node(s.to).place.point - a;
        nearest = std::min(
            nearest, std::sqrt(squared_length(p - (a + std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) * ab))));
      }
      EXPECT_LE(nearest, chord * h * (1 + 1e-9));
    }
  }
  EXPECT_GT(before, 2u);
}

TEST(Trace, CrossesItself) {
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 0}, {2, 1}, {3, 1}}));
  EXPECT_TRUE(crosses_itself({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
  EXPECT_TRUE(crosses_itself({{0, 0}, {2, 0}, {2, 1}, {1, 0}}));  // touches
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 0}, {1, 1}, {0, 0}}));
  EXPECT_FALSE(crosses_itself({{0, 0}, {1, 1}}));
}

}  // namespace
}  // namespace cutbench
