#include "harness/study/stability/placed_cuts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/base/names.h"
#include "harness/base/random.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

namespace {

constexpr int tried = 60;

Point2 turned(Point2 d, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * d.x - s * d.y, s * d.x + c * d.y};
}
Point2 left_of(Point2 d) { return {-d.y, d.x}; }
Curve segment(Point2 a, Point2 b) { return {Curve::Kind::polyline, false, {a, b}}; }

double distance(Point2 p, Point2 a, Point2 b) {
  const Point2 d = b - a;
  const double t = std::clamp(dot(p - a, d) / squared_length(d), 0.0, 1.0);
  return length(a + t * d - p);
}

/// A place where a cut may be made: its curves at any value of the swept number, and what they are meant to come near.
struct Spot {
  std::function<std::vector<Curve>(double)> curves;
  std::vector<VertexIndex> near = {};  ///< vertices that do not count
  bool near_border = false;            ///< nor does the border
  std::vector<Point2> far = {};        ///< points that, like the cuts' ends, keep clear of edges
};

class Placer {
 public:
  Placer(const Sheet& sheet, std::uint64_t seed, std::size_t i)
      : sheet_(sheet),
        h_(sheet.mean_edge()),
        extent_(extent_of(sheet)),
        random_(seed ^ (0x9E3779B97F4A7C15u * (i + 1))) {
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3 && sheet.triangle(TriangleIndex(t)).alive(); ++k) {
        const HalfEdge e = half_edge(TriangleIndex(t), k);
        edges_.push_back(e);
        if (sheet.on_border(e)) {
          border_.push_back(sheet.origin(e));
          border_.push_back(sheet.target(e));
        }
      }
  }

  /// \param places  values at which the cuts must keep clear
  std::vector<Curve> best(Spot (Placer::*draw)(), std::initializer_list<double> places, double place) {
    Spot chosen;
    double best_clearance = -1;
    for (int n = 0; n < tried; ++n) {
      Spot spot = (this->*draw)();
      double clearance = std::numeric_limits<double>::infinity();
      for (const double p : places)
        for (const Curve& curve : spot.curves(p)) clearance = std::min(clearance, clearance_of(curve, spot));
      if (clearance > best_clearance) {
        best_clearance = clearance;
        chosen = std::move(spot);
      }
    }
    return chosen.curves(place);
  }

  Spot past_vertex() {
    const VertexIndex v = sheet_.origin(edge_inside());
    const Point2 at = sheet_.rest(v), d = random_.direction();
    const double back = random_.between(1, 2.5), on = random_.between(1, 2.5), h = h_;
    return {[=](double place) {
              const Point2 near = at + place * h * left_of(d);
              return std::vector{segment(near - back * h * d, near + on * h * d)};
            },
            {v}};
  }

  Spot along_edge() {
    const HalfEdge e = edge_inside();
    const Point2 a = sheet_.rest(sheet_.origin(e)), b = sheet_.rest(sheet_.target(e)), d = unit(b - a);
    const double back = random_.between(0.2, 1), on = random_.between(0.2, 1), h = h_;
    return {[=](double place) {
              const Point2 aside = place * h * left_of(d);
              return std::vector{segment(a + aside - back * h * d, b + aside + on * h * d)};
            },
            {sheet_.origin(e), sheet_.target(e)}};
  }

  Spot along_border() {
    const double x = random_.between(extent_.low.x + 4 * h_, extent_.high.x - 8 * h_), wide = random_.between(2, 4);
    const double deep = random_.between(1, 2.5), y = extent_.low.y, h = h_;
    return {
        [=](double place) {
          const double x1 = x + wide * h, bottom = y + place * h, top = y + deep * h;
          return std::vector<Curve>{{Curve::Kind::polyline, false, {{x, top}, {x, bottom}, {x1, bottom}, {x1, top}}}};
        },
        {},
        true};
  }

  Spot tip_at_edge() {
    const HalfEdge e = edge_inside();
    const Point2 a = sheet_.rest(sheet_.origin(e)), b = sheet_.rest(sheet_.target(e));
    const Point2 middle = a + random_.between(0.4, 0.6) * (b - a);
    const Point2 d = turned(left_of(unit(b - a)), random_.between(-0.3, 0.3));
    const double back = random_.between(1, 2.5), h = h_;
    return {[=](double place) { return std::vector{segment(middle - back * h * d, middle - place * h * d)}; }, {}};
  }

  Spot recut() {
    const Point2 c = point_inside(), d = random_.direction();
    const double h = h_;
    return {[=](double degrees) {
              const Point2 e = turned(d, degrees * std::numbers::pi / 180);
              return std::vector{segment(c - 2 * h * d, c + 2 * h * d), segment(c - 2 * h * e, c + 2 * h * e)};
            },
            {},
            false,
            {c}};
  }

  Spot strip() {
    const Point2 c = point_inside(), d = random_.direction();
    const double h = h_;
    return {[=](double place) {
              const Point2 aside = place * h * left_of(d);
              return std::vector{segment(c - 1.5 * h * d, c + 1.5 * h * d),
                                 segment(c + aside - 1.5 * h * d, c + aside + 1.5 * h * d)};
            },
            {}};
  }

  std::vector<Curve> piece(double size) {
    const auto corners = sheet_.corners(triangle_of(edge_inside()));
    const Point2 centre = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
    Curve curve{Curve::Kind::polyline, true, {}};
    for (const Point2 p : corners) curve.points.push_back(size == 1 ? p : centre + size * (p - centre));
    return {curve};
  }

 private:
  static Point2 unit(Point2 d) { return 1 / length(d) * d; }
  Point2 point_inside() {
    const Point2 size = extent_.high - extent_.low;
    return {extent_.low.x + random_.between(0.25, 0.75) * size.x, extent_.low.y + random_.between(0.25, 0.75) * size.y};
  }
  HalfEdge edge_inside() {
    const Point2 p = point_inside();
    return *std::min_element(edges_.begin(), edges_.end(), [&](HalfEdge a, HalfEdge b) {
      return squared_length(sheet_.rest(sheet_.origin(a)) - p) < squared_length(sheet_.rest(sheet_.origin(b)) - p);
    });
  }

  /// How far a curve stays from vertices it is not meant to come near, and its ends from edges, in h.
  double clearance_of(const Curve& curve, const Spot& spot) const {
    const Point2 first = curve.points.front(), last = curve.points.back();
    double nearest = std::numeric_limits<double>::infinity();
    for (const HalfEdge e : edges_) {
      const Point2 a = sheet_.rest(sheet_.origin(e)), b = sheet_.rest(sheet_.target(e));
      const double reach = 5 * h_;
      if (squared_length(a - first) > reach * reach && squared_length(a - last) > reach * reach) continue;
      nearest = std::min({nearest, distance(first, a, b), distance(last, a, b)});
      for (const Point2 p : spot.far) nearest = std::min(nearest, distance(p, a, b));
      if (holds(spot, sheet_.origin(e))) continue;
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        nearest = std::min(nearest, distance(a, curve.points[i - 1], curve.points[i]));
    }
    return nearest / h_;
  }
  bool holds(const Spot& spot, VertexIndex v) const {
    return std::find(spot.near.begin(), spot.near.end(), v) != spot.near.end() ||
           (spot.near_border && std::find(border_.begin(), border_.end(), v) != border_.end());
  }

  const Sheet& sheet_;
  double h_;
  SheetExtent extent_;
  Random random_;
  std::vector<HalfEdge> edges_;
  std::vector<VertexIndex> border_;
};

constexpr const char* names[] = {"past_vertex", "along_edge", "along_border", "tip_at_edge",
                                 "recut",       "strip",      "piece",        "in_a_row"};

}  // namespace

std::span<const char* const> placed_cuts() { return names; }

std::vector<Curve> placed_cut(const std::string& name, double place, std::uint64_t seed, std::size_t i,
                              const Sheet& sheet) {
  if (name == "in_a_row") {
    std::vector<Curve> curves;
    for (std::size_t n = 0; n < to_size(place); ++n) curves.push_back(make_small_cut(seed + i, n, sheet));
    return curves;
  }
  if (std::find(std::begin(names), std::end(names), name) == std::end(names)) return make_case(name, seed, i, sheet);
  Placer placer(sheet, seed, i);
  if (name == "past_vertex") return placer.best(&Placer::past_vertex, {0, 0.1, 0.2, 0.5}, place);
  if (name == "along_edge") return placer.best(&Placer::along_edge, {0, 0.1, 0.2, 0.5}, place);
  if (name == "along_border") return placer.best(&Placer::along_border, {0.1, 0.2, 0.5}, place);
  if (name == "tip_at_edge") return placer.best(&Placer::tip_at_edge, {0.1, 0.5}, place);
  if (name == "recut") return placer.best(&Placer::recut, {90, 45, 20, 10, 5, 2}, place);
  if (name == "strip") return placer.best(&Placer::strip, {0, 0.1, 0.2, 0.5, 1}, place);
  return placer.piece(place);
}

}  // namespace cutbench
