// Draws the cuts of the families (cut_families.h): in cuts_by_extent.cpp those that depend on the sheet's extent alone,
// in cuts_by_triangles.cpp those that depend on its triangles.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "harness/base/random.h"
#include "harness/cases/cut_families.h"

namespace cutbench {

using Curves = std::vector<Curve>;
using Points = std::vector<Point2>;

/// Draws curves on the unit square and maps them to the sheet's bounding box. No two random numbers are drawn in one
/// expression, except within braces, where their order is the same for every compiler.
class Generator {
 public:
  Generator(const Sheet& sheet, std::uint64_t seed, std::size_t i)
      : sheet_(sheet), extent_(extent_of(sheet)), random_(seed), i_(i) {}

  Curves straight() { return {placed(polyline({beyond(left), beyond(coin_side())}))}; }
  Curves curved() {
    const Side from = any_side();
    return {placed(smooth({on(from), on(other_side(from))}, true))};
  }
  Curves partial() { return {placed(smooth({inside(), inside()}, false))}; }
  Curves border_inward() {
    const Side from = any_side();
    return {placed(smooth({random_.coin() ? on(from) : beyond(from), inside()}, false))};
  }
  Curves cut_out();
  Curves recut();
  Curves several();
  Curves self_crossing();
  Curves tiny_loop();
  Curves tiny_open();
  Curves u_turn();
  Curves through_vertices();
  Curves along_edges();

 private:
  enum Side { left, bottom, right, top };
  static Curve bezier(Points points, bool closed = false) { return {Curve::Kind::bezier, closed, std::move(points)}; }
  static Curve polyline(Points points, bool closed = false) {
    return {Curve::Kind::polyline, closed, std::move(points)};
  }

  Side any_side() { return static_cast<Side>(random_.below(4)); }
  Side other_side(Side s) { return static_cast<Side>((s + 1 + random_.below(3)) % 4); }
  Side coin_side() { return random_.coin() ? right : other_side(left); }

  Point2 on(Side side, double depth = 0) {
    const double u = random_.between(0.15, 0.85);
    const Point2 at[] = {{depth, u}, {u, depth}, {1 - depth, u}, {u, 1 - depth}};
    return at[side];
  }
  /// On a side of the square in one of three cases, else outside.
  Point2 beyond(Side side) { return on(side, random_.below(3) == 0 ? 0 : -random_.between(0.01, 0.2)); }
  Point2 inside() { return {random_.between(0.1, 0.9), random_.between(0.1, 0.9)}; }

  /// No tight bend, no crossing with itself; and strictly inside the unit square but for the ends, if asked.
  static bool is_smooth(const Points& p, bool stays_inside);
  struct Ends {
    Point2 from, to;
  };
  Curve smooth(Ends ends, bool stays_inside);
  Curve blob(Point2 centre, double radius);
  Point2 onto_sheet(Point2 p) const {  // 0 and 1 go to the box's own coordinates exactly
    const auto [low, high, h] = extent_;
    return {p.x == 1 ? high.x : low.x + p.x * (high.x - low.x), p.y == 1 ? high.y : low.y + p.y * (high.y - low.y)};
  }
  Curve placed(Curve curve) const {
    for (Point2& p : curve.points) p = onto_sheet(p);
    return curve;
  }

  TriangleIndex any_triangle() {
    for (;;)
      if (const TriangleIndex t(random_.below(sheet_.triangle_slots())); sheet_.triangle(t).alive()) return t;
  }
  VertexIndex any_vertex() { return sheet_.triangle(any_triangle()).vertex[random_.below(3)]; }
  std::vector<VertexIndex> edge_chain();
  /// A point inside a triangle and its distance from the triangle's edges.
  std::pair<Point2, double> inside_triangle();
  Curve ring(Point2 centre, double radius, std::size_t corners, std::size_t step = 1);

  const Sheet& sheet_;
  SheetExtent extent_;
  Random random_;
  std::size_t i_;
};

}  // namespace cutbench
