// adaptive_remesh: edges fit the size field, what is frozen stays, and the work follows the cut.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "harness/mesh/one_ring.h"
#include "methods/adaptive_remesh/deformed_metric.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

Curve line(std::vector<Point2> points) { return {Curve::Kind::polyline, false, std::move(points)}; }

class Remeshed {
 public:
  Remeshed(const std::string& family, int n, double parameter, const std::string& method = "adaptive_remesh")
      : sheet(make_sheet(family, n)), method_(find_method(method).make(parameter)), locator_(sheet) {}

  CutOutcome cut(const Curve& curve, const CutOptions& options = {}) {
    return cutter_.cut(sheet, locator_, curve, *method_, options);
  }
  /// Calls look(a, b) for the ends of every edge, once or twice.
  template <class Look>
  void for_each_edge(Look look) const {
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      if (const Triangle& triangle = sheet.triangle(TriangleIndex(t)); triangle.alive())
        for (std::size_t k = 0; k < 3; ++k) look(triangle.vertex[k], triangle.vertex[(k + 1) % 3]);
  }
  std::size_t vertices_near(Point2 p, double radius) const {
    std::size_t count = 0;
    for (std::size_t v = 0; v < sheet.vertex_slots(); ++v)
      count += sheet.triangle_of_vertex(VertexIndex(v)).valid() && distance(sheet.rest(VertexIndex(v)), p) < radius;
    return count;
  }

  Sheet sheet;

 private:
  std::unique_ptr<CuttingMethod> method_;
  Locator locator_;
  Cutter cutter_;
};

/// The formula of the field, with its gradation of 0.3, at p near one tip.
double field(double h, double tip, Point2 p, Point2 at) { return std::min(h, tip * h + 0.3 * distance(p, at)); }

TEST(AdaptiveRemesh, NoEdgeNearATipIsTooLongForTheField) {
  constexpr double tip = 0.3;
  std::size_t edges = 0, early = 0, cuts = 0;
  for (const std::string family : sheet_families())
    for (std::size_t i = 0; i < scaled(20); ++i) {
      Random random(900 + i);
      const Point2 a{random.between(0.3, 0.4), random.between(0.3, 0.7)};
      const Point2 b{random.between(0.6, 0.7), random.between(0.3, 0.7)};
      Remeshed body(family, 20, tip);
      const double h = body.sheet.mean_edge();
      const CutOutcome outcome = body.cut(line({a, b}));
      ASSERT_EQ(outcome.status, Status::ok) << outcome.reason;
      ++cuts;
      if (!outcome.reason.empty()) {  // the limit of rounds was met
        ++early;
        continue;
      }
      body.for_each_edge([&](VertexIndex v, VertexIndex w) {
        const Point2 p = body.sheet.rest(v), q = body.sheet.rest(w), middle = 0.5 * (p + q);
        for (const Point2 at : {a, b}) {
          if (distance(middle, at) > (1 - tip) / 0.3 * h) continue;
          ++edges;
          EXPECT_LE(distance(p, q), (1 + 1e-12) * std::numbers::sqrt2 * field(h, tip, middle, at)) << family << i;
        }
      });
    }
  EXPECT_GT(edges, 100 * cuts);  // the rings of fine triangles are there
  EXPECT_LE(early, cuts / 10);
}

/// Beside a straight path, whose vertices may go: against flips alone.
TEST(AdaptiveRemesh, CollapsesMostShortEdges) {
  const auto short_edges = [](const std::string& family, std::size_t i, double tip) {
    Random random(300 + i);
    const double from = random.between(0.2, 0.8), to = random.between(0.2, 0.8);
    Remeshed body(family, 20, tip);
    EXPECT_EQ(body.cut(line({{-0.1, from}, {1.1, to}})).status, Status::ok);
    const double h = body.sheet.mean_edge();
    std::size_t count = 0;
    body.for_each_edge(
        [&](VertexIndex v, VertexIndex w) { count += distance(body.sheet.rest(v), body.sheet.rest(w)) < 0.4 * h; });
    return count;
  };
  for (const std::string family : {"grid", "alternating", "delaunay"}) {  // in a graded sheet h says little
    std::size_t before = 0, after = 0;
    for (std::size_t i = 0; i < scaled(20); ++i) {
      before += short_edges(family, i, 0);
      after += short_edges(family, i, 1);
    }
    EXPECT_LT(after, before / 2) << family;
  }
}

/// Vertices of a curved path may go within the tolerance: against every crossing kept.
TEST(AdaptiveRemesh, LeavesFewerShortEdgesWhereThePathMayBeSimplified) {
  const auto short_edges = [](double tolerance, const std::string& family, std::size_t i) {
    Remeshed body(family, 20, tolerance, "adaptive_remesh:tolerance");
    const double h = body.sheet.mean_edge();
    for (const Curve& curve : make_case("curved", 31, i, body.sheet))
      EXPECT_EQ(body.cut(curve, {.chord_tolerance = 0.05}).status, Status::ok);
    std::size_t count = 0;
    body.for_each_edge(
        [&](VertexIndex v, VertexIndex w) { count += distance(body.sheet.rest(v), body.sheet.rest(w)) < 0.1 * h; });
    return count;
  };
  for (const std::string family : {"grid", "alternating", "delaunay"}) {
    std::size_t exact = 0, simplified = 0;
    for (std::size_t i = 0; i < scaled(20); ++i) {
      exact += short_edges(0, family, i);
      simplified += short_edges(0.05, family, i);
    }
    EXPECT_LT(10 * simplified, exact) << family;
  }
}

/// On a straight border a vertex may slide.
bool slid(Point2 from, Point2 to) {
  const auto stays = [](double a, double b) { return a == b && (a == 0 || a == 1); };
  return stays(from.x, to.x) != stays(from.y, to.y);
}

TEST(AdaptiveRemesh, NothingFrozenMoves) {
  std::size_t gone_when_free = 0;
  for (const std::string family : sheet_families())
    for (const char* cuts : {"recut", "several", "partial"})
      for (const bool held : {false, true})
        for (std::size_t i = 0; i < scaled(5); ++i) {
          Remeshed body(family, 12, 0.4);
          if (held)
            for (std::size_t v = 0; v < body.sheet.vertex_slots(); ++v) body.sheet.hold(VertexIndex(v));
          for (const Curve& curve : make_case(cuts, 17, i, body.sheet)) {
            const Sheet before = body.sheet;
            body.cut(curve);
            for (std::size_t k = 0; k < before.vertex_slots(); ++k) {
              const VertexIndex v(k);
              if (!before.triangle_of_vertex(v).valid()) continue;
              bool frozen = before.is_held(v);
              for_each_separating_end(before, v, [&](VertexIndex) { frozen = true; });
              const bool stays = body.sheet.triangle_of_vertex(v).valid() && !body.sheet.is_newer(v, before) &&
                                 (body.sheet.rest(v) == before.rest(v) ||
                                  (!before.is_held(v) && slid(before.rest(v), body.sheet.rest(v))));
              EXPECT_TRUE(stays || !frozen) << family << " " << cuts << " " << i << ", vertex " << k;
              gone_when_free += !stays;
            }
          }
        }
  EXPECT_GT(gone_when_free, scaled(100));
}

TEST(AdaptiveRemesh, CoarsensBehindTheBlade) {
  for (const std::string family : sheet_families()) {
    Remeshed body(family, 24, 0.2);
    const Point2 stop{0.52, 0.51};
    ASSERT_EQ(body.cut(line({{0.21, 0.42}, stop})).status, Status::ok);
    const double radius = 2 * body.sheet.mean_edge();
    const std::size_t at_tip = body.vertices_near(stop, radius);
    ASSERT_EQ(body.cut(line({stop, {0.83, 0.58}})).status, Status::ok);
    EXPECT_LT(body.vertices_near(stop, radius), 0.8 * to_double(at_tip)) << family;
  }
}

/// The same cut, in cells, of grids of 512 to 8,192 triangles, whose mean edges differ by 1 % of a cell.
TEST(AdaptiveRemesh, WorkFollowsTheCutAndNotTheSheet) {
  std::vector<std::size_t> touched;
  for (const int n : {16, 32, 64}) {
    Remeshed body("grid", n, 0.25);
    const double cell = 1.0 / n;
    ASSERT_EQ(body.cut(line({{0.5 - 2.25 * cell, 0.5 - 0.375 * cell}, {0.5 + 2.125 * cell, 0.5 + 0.75 * cell}})).status,
              Status::ok);
    touched.push_back(body.sheet.log().touched.size() + body.sheet.log().new_vertices.size());
  }
  const auto [least, most] = std::ranges::minmax(touched);
  EXPECT_GT(least, 10U);
  EXPECT_LT(most, 1.3 * to_double(least));
}

/// Vertices that a cut across the middle makes in a sheet at these places.
template <class Place>
std::size_t made(const std::string& method, double parameter, Place place) {
  Remeshed body("grid", 20, parameter, method);
  for (std::size_t d = 0; d < body.sheet.deformed_slots(); ++d) {
    const DeformedIndex at(d);
    body.sheet.set_position(at, place(body.sheet.rest(body.sheet.rest_vertex(at))));
  }
  const double area = surface_area(body.sheet);
  const std::size_t before = body.sheet.vertex_count();
  EXPECT_EQ(body.cut(line({{0.21, 0.52}, {0.79, 0.47}})).status, Status::ok);
  EXPECT_EQ(faults(body.sheet), "");
  EXPECT_NEAR(surface_area(body.sheet), area, 0.02 * area);
  return body.sheet.vertex_count() - before;
}

TEST(AdaptiveRemesh, IsFineWhereTheSheetIsCurvedOrCompressed) {
  const auto flat = [](Point2 p) { return Point3{p.x, p.y, 0}; };
  const auto tilted = [](Point2 p) { return Point3{0.6 * p.x, p.y, 0.8 * p.x}; };
  const auto stretched = [](Point2 p) { return Point3{1.3 * p.x, 1.3 * p.y, 0}; };
  // Its chords would be compressed if it were not stretched.
  const auto rolled = [](Point2 p) { return Point3{0.11 * std::sin(10 * p.x), p.y, 0.11 * std::cos(10 * p.x)}; };
  const auto pressed = [](Point2 p) { return Point3{0.95 * p.x, p.y, 0}; };
  const std::size_t at_rest = made("adaptive_remesh", 0.2, flat);
  EXPECT_EQ(made("adaptive_remesh", 0.2, tilted), at_rest);
  EXPECT_EQ(made("adaptive_remesh", 0.2, stretched), at_rest);
  EXPECT_GT(made("adaptive_remesh", 0.2, rolled), 2 * at_rest);
  EXPECT_EQ(made("adaptive_remesh:angle", 0, rolled), made("adaptive_remesh:angle", 0, flat));
  EXPECT_GT(made("adaptive_remesh", 0.2, pressed), 2 * at_rest);
  EXPECT_EQ(made("adaptive_remesh:compression", 0, pressed), at_rest);
}

/// A cylinder of radius r asks for edges of r times the angle, where its edges run along it.
TEST(AdaptiveRemesh, TakesItsTermsFromTheDeformedSheet) {
  constexpr double r = 0.3, angle = 0.2;
  Sheet sheet(make_sheet("grid", 40));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
    sheet.set_position(DeformedIndex(d), {r * std::sin(p.x / r), p.y, r * std::cos(p.x / r)});
  }
  const DeformedState state;
  const DeformedTerms terms{.angle = angle, .compression = 0};
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside &= !sheet.on_border(half_edge(TriangleIndex(t), k));
    if (!inside) continue;
    sum += std::sqrt(deformed_metric(sheet, state, TriangleIndex(t), terms, 1, 1));
    ++count;
  }
  EXPECT_NEAR(sum / to_double(count), 1 / (r * angle), 0.02 / (r * angle));
}

/// A long edge of the path that could not be divided drew the vertices beside it nearer in every round: 15 of 1,200
/// partial cuts of flat sheets had aspect ratios from 4e7 to infinity.
TEST(AdaptiveRemesh, NoLongEdgeOfThePathDrawsVerticesNearer) {
  for (const std::string family : sheet_families())
    for (std::size_t i = 0; i < scaled(300); ++i) {
      Remeshed body(family, 20, 0.2);
      for (const Curve& curve : make_case("partial", 1, i, Sheet(body.sheet))) body.cut(curve);
      double worst = 0;
      for (std::size_t t = 0; t < body.sheet.triangle_slots(); ++t)
        if (body.sheet.triangle(TriangleIndex(t)).alive()) {
          const auto c = body.sheet.corners(TriangleIndex(t));
          worst = std::max(worst, oriented_aspect(c[0], c[1], c[2]));
        }
      EXPECT_LT(worst, 1e4) << family << ", case " << i;
    }
}

}  // namespace
}  // namespace cutbench
