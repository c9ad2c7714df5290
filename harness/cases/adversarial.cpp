#include "harness/cases/adversarial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Points = std::vector<Point2>;

constexpr const char* families[] = {"on_vertices",  "on_edges",      "few_ulps",   "collinear",      "on_older_cuts",
                                    "sharp_return", "through_point", "tiny_loops", "touches_itself", "ordinary"};

/// The cut families that "ordinary" draws from. A list of its own: a family that is added to cut_families() must not
/// change the cuts of published seeds, and a change here changes all of them.
constexpr const char* ordinary_families[] = {
    "straight",      "curved",    "partial",   "border_inward", "cut_out",          "recut",      "several",
    "self_crossing", "tiny_loop", "tiny_open", "u_turn",        "through_vertices", "along_edges"};

Point2 moved_by_ulps(Point2 p, int x, int y) {
  const auto step = [](double c, int ulps) {
    const double towards =
        ulps > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
    for (int k = 0; k < std::abs(ulps); ++k) c = std::nextafter(c, towards);
    return c;
  };
  return {step(p.x, x), step(p.y, y)};
}

/// Draws the curves of one case. No two random numbers are drawn in one expression, except within braces, where their
/// order is the same for every compiler.
class AdversarialCuts {
 public:
  AdversarialCuts(const Sheet& sheet, std::uint64_t seed, std::size_t i)
      : sheet_(sheet), extent_(extent_of(sheet)), random_(seed * 0x9E3779B97F4A7C15u + i), i_(i) {}

  AdversarialCase make() {
    const std::size_t family = i_ % std::size(families), count = 1 + random_.below(5);
    if (family == 4) cuts_.push_back(through([this] { return any_point(); }));  // an older one
    do cuts_.push_back(curve_of(cuts_.empty() || random_.coin(0.4) ? family : random_.below(std::size(families))));
    while (cuts_.size() < count);
    return {families[family], std::move(cuts_)};
  }

 private:
  // --- points ---
  TriangleIndex any_triangle() {
    for (;;)
      if (const TriangleIndex t(random_.below(sheet_.triangle_slots())); sheet_.triangle(t).alive()) return t;
  }
  std::array<Point2, 2> any_edge() {
    const auto c = sheet_.corners(any_triangle());
    const std::size_t k = random_.below(3);
    return {c[k], c[(k + 1) % 3]};
  }
  Point2 vertex() { return any_edge()[0]; }
  Point2 on_edge() {
    const auto [a, b] = any_edge();
    return a + fraction() * (b - a);
  }
  Point2 inside() {
    const auto c = sheet_.corners(any_triangle());
    const double u = random_.unit(), v = random_.unit() * (1 - u);
    return c[0] + (u * (c[1] - c[0]) + v * (c[2] - c[0]));
  }
  Point2 anywhere() {
    const Point2 size = extent_.high - extent_.low;
    return extent_.low + Point2{random_.between(-0.1, 1.1) * size.x, random_.between(-0.1, 1.1) * size.y};
  }
  /// A point of an older cut: one of its own points, or on the straight line between two of them.
  Point2 on_older() {
    if (cuts_.empty()) return on_edge();
    const Points& p = cuts_[random_.below(cuts_.size())].points;
    const std::size_t k = random_.below(p.size());
    if (random_.coin(0.4)) return p[k];
    return p[k] + fraction() * (p[(k + 1) % p.size()] - p[k]);
  }
  /// Anywhere, in the middle, or very near an end.
  double fraction() {
    switch (random_.below(4)) {
      case 0:
        return 0.5;
      case 1: {
        const double small = std::pow(10.0, -random_.between(1, 16));
        return random_.coin() ? small : 1 - small;
      }
      default:
        return random_.unit();
    }
  }
  double tiny() { return std::pow(10.0, -random_.between(2, 17)) * extent_.mean_edge; }
  int some_ulps() { return to_int(random_.below(33)) - 16; }
  Point2 nudged(Point2 p) {
    switch (random_.below(4)) {
      case 0: {
        const int x = some_ulps(), y = some_ulps();
        return moved_by_ulps(p, x, y);
      }
      case 1: {
        const double length = tiny();
        return p + length * random_.direction();
      }
      default:
        return p;
    }
  }
  Point2 ulps_away(Point2 p) {
    const int x = some_ulps(), y = some_ulps();
    return moved_by_ulps(p, x, y);
  }
  Point2 any_point() {
    switch (random_.below(6)) {
      case 0:
        return nudged(vertex());
      case 1:
        return nudged(on_edge());
      case 2:
        return nudged(on_older());
      case 3:
        return anywhere();
      default:
        return inside();
    }
  }

  // --- curves ---
  template <class Draw>
  Points draw(std::size_t count, Draw point) {
    Points points;
    while (points.size() < count) points.push_back(point());
    return points;
  }
  /// Through the points: a polyline, the line through two of them and beyond, or Beziers with the points as controls.
  template <class Draw>
  Curve through(Draw point) {
    switch (random_.below(5)) {
      case 0: {
        const Point2 a = point(), b = point();
        return {Curve::Kind::polyline, false, {a - 3 * (b - a), b + 3 * (b - a)}};
      }
      case 1:
        return {Curve::Kind::bezier, false, draw(4, point)};
      case 2: {
        const bool closed = random_.coin(0.3);
        return {Curve::Kind::polyline, closed, draw(3 + random_.below(3), point)};
      }
      default:
        return {Curve::Kind::polyline, false, draw(2 + random_.below(3), point)};
    }
  }
  Curve few_ulps() {
    return through([this] {
      switch (random_.below(3)) {
        case 0:
          return ulps_away(vertex());
        case 1:
          return ulps_away(on_edge());
        default:
          return ulps_away(on_older());
      }
    });
  }
  /// Along the line of an edge, on it or beside it, from before it to behind it.
  Curve collinear() {
    const auto [a, b] = any_edge();
    const double from = random_.coin() ? -random_.between(0, 3) : fraction(), to = random_.between(0, 4);
    Points points{a + from * (b - a), a + to * (b - a)};
    if (random_.coin(0.3)) points.insert(points.begin() + 1, a + fraction() * (b - a));
    if (random_.coin(0.3)) points.push_back(any_point());
    for (Point2& p : points) p = nudged(p);
    return {Curve::Kind::polyline, false, points};
  }
  /// An older cut once more: as it was, reversed, in part, or shifted a little; or across it at its own points.
  Curve on_older_cut() {
    if (cuts_.empty()) return through([this] { return any_point(); });
    Curve curve = cuts_[random_.below(cuts_.size())];
    Points& p = curve.points;
    switch (random_.below(6)) {
      case 0:
        break;
      case 1:
        std::reverse(p.begin(), p.end());
        break;
      case 2: {  // its ends joined, by a line along or across it
        const Point2 a = on_older(), b = on_older();
        return {Curve::Kind::polyline, false, {nudged(a), nudged(b)}};
      }
      case 3: {
        const double length = tiny();
        const Point2 shift = length * random_.direction();
        for (Point2& q : p) q = q + shift;
        if (curve.kind == Curve::Kind::bezier && curve.closed) p.back() = p.front();
        break;
      }
      case 4: {  // from it
        const Point2 a = nudged(on_older()), b = any_point();
        return {Curve::Kind::polyline, false, {a, b}};
      }
      default:
        return through([this] { return random_.coin(0.7) ? nudged(on_older()) : any_point(); });
    }
    return curve;
  }
  /// Out and back: on itself, or nearly.
  Curve sharp_return() {
    const Point2 a = any_point(), tip = any_point();
    Point2 b = a;
    switch (random_.below(4)) {
      case 0:
        b = nudged(a);
        break;
      case 1: {
        const double length = tiny();
        b = a + length * random_.direction();
        break;
      }
      case 2:
        b = tip + random_.between(0, 1.5) * (a - tip);  // back on the very line, perhaps too far
        break;
      default:
        break;
    }
    switch (random_.below(4)) {
      case 0:
        return {Curve::Kind::bezier, false, {a, tip, tip, b}};
      case 1: {  // a cusp
        const Point2 c = tip + (tip - a);
        return {Curve::Kind::bezier, false, {a, c, a + (tip - b), b}};
      }
      default: {
        Points points{a, tip, b};
        if (random_.coin(0.3)) points.push_back(any_point());
        return {Curve::Kind::polyline, false, points};
      }
    }
  }
  /// Through one point that is the same for all such cuts of the case.
  Curve through_point() {
    if (!common_) common_ = nudged(random_.coin() ? inside() : on_edge());
    const Point2 d = random_.between(0.5, 3) * extent_.mean_edge * random_.direction();
    switch (random_.below(4)) {
      case 0:
        return {Curve::Kind::polyline, false, {*common_, *common_ + d}};
      case 1:
        return {Curve::Kind::polyline, false, {*common_ - 2 * d, *common_, any_point()}};
      case 2:
        return {Curve::Kind::polyline, false, {*common_ - 2 * d, *common_, *common_ + d}};
      default:
        return {Curve::Kind::polyline, false, {*common_ - d, *common_ + d}};
    }
  }
  /// Round a vertex, on an edge, anywhere; down to the size of the rounding.
  Curve tiny_loop() {
    const Point2 centre = any_point();
    const double radius = random_.coin() ? tiny() : random_.between(0.01, 1.5) * extent_.mean_edge;
    Points points;
    const std::size_t corners = 3 + random_.below(4);
    while (points.size() < corners) {
      const double r = radius * random_.between(0.3, 1);
      points.push_back(centre + r * random_.direction());
    }
    if (random_.coin(0.7)) {  // in order round the centre, so that it does not cross itself
      const auto is_upper = [&](Point2 p) { return p.y >= centre.y; };
      std::sort(points.begin(), points.end(), [&](Point2 a, Point2 b) {
        return is_upper(a) != is_upper(b) ? is_upper(b) : orientation(centre, a, b) > 0;
      });
    }
    if (random_.coin(0.3) && points.size() >= 3) {
      points.resize(3);
      points.push_back(points.front());
      return {Curve::Kind::bezier, true, points};
    }
    return {Curve::Kind::polyline, true, points};
  }
  /// Comes back to its own start, corners and lines.
  Curve touches_itself() {
    Points points{any_point(), any_point()};
    while (points.size() < 6 && !(points.size() > 3 && random_.coin(0.3))) {
      const std::size_t k = random_.below(points.size() - 1);
      switch (random_.below(3)) {
        case 0:
          points.push_back(nudged(points[k]));
          break;
        case 1:
          points.push_back(nudged(points[k] + fraction() * (points[k + 1] - points[k])));
          break;
        default:
          points.push_back(any_point());
      }
    }
    return {Curve::Kind::polyline, false, points};
  }
  Curve ordinary() {
    const std::uint64_t seed = random_.bits();
    return make_case(ordinary_families[random_.below(std::size(ordinary_families))], seed, i_, sheet_).front();
  }

  Curve curve_of(std::size_t family) {
    switch (family) {
      case 0:
        return through([this] { return vertex(); });
      case 1:
        return through([this] { return nudged(on_edge()); });
      case 2:
        return few_ulps();
      case 3:
        return collinear();
      case 4:
        return on_older_cut();
      case 5:
        return sharp_return();
      case 6:
        return through_point();
      case 7:
        return tiny_loop();
      case 8:
        return touches_itself();
      default:
        return ordinary();
    }
  }

  const Sheet& sheet_;
  SheetExtent extent_;
  Random random_;
  std::size_t i_;
  std::vector<Curve> cuts_;
  std::optional<Point2> common_;
};

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 ab = b - a;
  const double l2 = squared_length(ab), s = l2 > 0 ? std::clamp(dot(p - a, ab) / l2, 0.0, 1.0) : 0.0;
  return std::sqrt(squared_length(p - (a + s * ab)));
}

/// The straight pieces of a polyline; of a Bezier only its ends count, since its flattening is not part of the case.
std::vector<std::array<Point2, 2>> pieces_of(const Curve& curve) {
  std::vector<std::array<Point2, 2>> pieces;
  const auto& p = curve.points;
  if (curve.kind == Curve::Kind::bezier) return {{p.front(), p.front()}, {p.back(), p.back()}};
  for (std::size_t k = 0; k + 1 < p.size(); ++k) pieces.push_back({p[k], p[k + 1]});
  if (curve.closed) pieces.push_back({p.back(), p.front()});
  return pieces;
}

}  // namespace

std::span<const char* const> adversarial_families() { return families; }
std::span<const char* const> adversarial_cut_families() { return ordinary_families; }

AdversarialCase make_adversarial_case(std::uint64_t seed, std::size_t i, const Sheet& sheet) {
  return AdversarialCuts(sheet, seed, i).make();
}

double nearest_event(const std::vector<Curve>& cuts, const Sheet& sheet) {
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<std::array<Point2, 2>> older;
  for (const Curve& curve : cuts) {
    const auto pieces = pieces_of(curve);
    for (const auto& [a, b] : pieces) {
      for (std::size_t v = 0; v < sheet.vertex_slots(); ++v)
        if (sheet.triangle_of_vertex(VertexIndex(v)).valid())
          nearest = std::min(nearest, distance_to_segment(sheet.rest(VertexIndex(v)), a, b));
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
        if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
        const auto c = sheet.corners(TriangleIndex(t));
        for (std::size_t k = 0; k < 3; ++k)
          for (Point2 end : {a, b}) nearest = std::min(nearest, distance_to_segment(end, c[k], c[(k + 1) % 3]));
      }
      for (const auto& [c, d] : older)
        nearest = std::min({nearest, distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                            distance_to_segment(c, a, b), distance_to_segment(d, a, b)});
    }
    older.insert(older.end(), pieces.begin(), pieces.end());
  }
  return nearest / sheet.mean_edge();
}

}  // namespace cutbench
