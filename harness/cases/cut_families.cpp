#include "harness/cases/cut_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "harness/base/random.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/one_ring.h"

namespace cutbench {

namespace {

enum Side { left, bottom, right, top };
using Curves = std::vector<Curve>;
using Points = std::vector<Point2>;
Curve bezier(Points points, bool closed = false) { return {Curve::Kind::bezier, closed, std::move(points)}; }
Curve polyline(Points points, bool closed = false) { return {Curve::Kind::polyline, closed, std::move(points)}; }

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

Point2 bezier_point(const Points& p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

bool has_crossing(const Points& p) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j) {
      const Point2 a = p[i], b = p[i + 1], c = p[j], d = p[j + 1];
      if (cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0) return true;
    }
  return false;
}

/// No tight bend, no crossing with itself; and strictly inside the unit square but for the ends, if asked.
bool is_smooth(const Points& p, bool stays_inside) {
  constexpr int n = 64;
  constexpr double radius = 0.05;
  Points points;
  for (int k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / n, s = 1 - t;
    const Point2 velocity = 3 * s * s * (p[1] - p[0]) + 6 * s * t * (p[2] - p[1]) + 3 * t * t * (p[3] - p[2]);
    const Point2 acceleration = 6 * s * (p[2] - 2 * p[1] + p[0]) + 6 * t * (p[3] - 2 * p[2] + p[1]);
    const double speed2 = squared_length(velocity);
    if (speed2 * std::sqrt(speed2) < radius * std::abs(cross(velocity, acceleration))) return false;
    points.push_back(bezier_point(p, t));
    const Point2 q = points.back();
    if (stays_inside && k > 0 && k < n && std::min({q.x, q.y, 1 - q.x, 1 - q.y}) <= 0) return false;
  }
  return !has_crossing(points);
}

Curve Generator::smooth(Ends ends, bool stays_inside) {
  auto [from, to] = ends;
  while (squared_length(to - from) < 0.25 * 0.25) to = inside();
  for (;;) {
    const Points points{from,
                        {random_.between(-0.1, 1.1), random_.between(-0.1, 1.1)},
                        {random_.between(-0.1, 1.1), random_.between(-0.1, 1.1)},
                        to};
    if (is_smooth(points, stays_inside)) return bezier(points);
  }
}

/// Eight points about a centre, joined with Catmull and Rom's tangents.
Curve Generator::blob(Point2 centre, double radius) {
  const double d = std::sqrt(0.5);
  const Point2 eighths[] = {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}};
  const Point2 turn = random_.direction();
  Points at;
  for (Point2 e : eighths) {
    const double r = radius * random_.between(0.8, 1.2);
    at.push_back({centre.x + r * (turn.x * e.x - turn.y * e.y), centre.y + r * (turn.y * e.x + turn.x * e.y)});
  }
  Points points{at[0]};
  for (std::size_t k = 0; k < 8; ++k) {
    const auto p = [&](std::size_t step) { return at[(k + step) % 8]; };
    points.push_back(p(0) + 1.0 / 6 * (p(1) - p(7)));
    points.push_back(p(1) - 1.0 / 6 * (p(2) - p(0)));
    points.push_back(p(1));
  }
  return bezier(std::move(points), true);
}

Curves Generator::cut_out() {
  const double radius = random_.between(0.06, 0.25);
  Point2 centre{random_.between(0.35, 0.65), random_.between(0.35, 0.65)};
  if (const double depth = random_.between(-0.5, 0.5) * radius; i_ % 4 == 3) centre = on(any_side(), depth);
  return {placed(blob(centre, radius))};
}

Curves Generator::recut() {
  Curves cuts{placed(smooth({on(left), on(right)}, true)), placed(smooth({on(bottom), on(top)}, true))};
  if (random_.coin()) std::swap(cuts[0], cuts[1]);
  return cuts;
}

Curves Generator::several() {
  Curves cuts;
  while (cuts.size() < 4) {
    constexpr Curves (Generator::*kinds[])() = {&Generator::straight, &Generator::curved, &Generator::partial,
                                                &Generator::border_inward, &Generator::cut_out};
    cuts.push_back((this->*kinds[random_.below(5)])().front());
  }
  return cuts;
}

/// Every step-th corner of a regular octagon or pentagon about the centre, turned at random.
Curve Generator::ring(Point2 centre, double radius, std::size_t corners, std::size_t step) {
  // cos and sin of 72 degrees, to the last digit; no sines, which differ between machines.
  const Point2 fifth{0.30901699437494742, 0.95105651629515357}, eighth{std::sqrt(0.5), std::sqrt(0.5)};
  const Point2 turn = corners == 5 ? fifth : eighth;
  Points all{random_.direction()}, points;
  while (all.size() < corners) {
    const Point2 p = all.back();
    all.push_back({turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y});
  }
  for (std::size_t k = 0; k < corners; ++k) points.push_back(centre + radius * all[k * step % corners]);
  return polyline(std::move(points), true);
}

Curves Generator::self_crossing() {
  const Point2 centre{random_.between(0.35, 0.65), random_.between(0.35, 0.65)}, u = random_.direction();
  const double size = random_.between(0.1, 0.3);
  const auto at = [&](double x, double y) { return centre + size * Point2{x * u.x - y * u.y, x * u.y + y * u.x}; };
  switch (i_ % 3) {
    case 0:
      return {placed(bezier({at(-1, -0.7), at(3, 1.5), at(-3, 1.5), at(1, -0.7)}))};
    case 1:
      return {placed(ring(centre, size, 5, 2))};
    default:  // starts where it crosses itself
      return {placed(
          bezier({at(0, 0), at(1.2, 1.2), at(1.2, -1.2), at(0, 0), at(-1.2, 1.2), at(-1.2, -1.2), at(0, 0)}, true))};
  }
}

std::pair<Point2, double> Generator::inside_triangle() {
  const auto c = sheet_.corners(any_triangle());
  double a = random_.between(0.1, 1), b = random_.between(0.1, 1), d = random_.between(0.1, 1);
  const double sum = a + b + d;
  const Point2 p = a / sum * c[0] + (b / sum * c[1] + d / sum * c[2]);
  double nearest = sheet_.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 from = c[k], along = c[(k + 1) % 3] - from;
    nearest = std::min(nearest, cross(along, p - from) / std::sqrt(squared_length(along)));
  }
  return {p, nearest};
}

Curves Generator::tiny_loop() {
  const auto [centre, space] = inside_triangle();
  const double radius = space * random_.between(0.05, 0.8);
  switch (i_ % 4) {
    case 0:
      return {blob(centre, radius)};
    case 1:
    case 2:
      return {ring(centre, radius, i_ % 2 == 1 ? 5 : 8)};
    default: {
      const Point2 u = radius * random_.direction(), v{-u.y, u.x};
      return {polyline({centre + u, centre - 0.6 * u + 0.7 * v, centre - 0.5 * u - 0.8 * v}, true)};
    }
  }
}

Curves Generator::tiny_open() {
  const auto [centre, space] = inside_triangle();
  const auto point = [this] {
    const double distance = random_.between(0.1, 0.9);
    return distance * random_.direction();
  };
  Points points{point(), point()};
  const bool curved = i_ % 3 == 0;  // and smooth: what flattening does to a cusp is anybody's guess
  while (curved && (points.size() < 4 || !is_smooth(points, false))) points = {point(), point(), point(), point()};
  while (i_ % 3 == 2 && points.size() < 5) points.push_back(point());  // these may cross themselves
  for (Point2& p : points) p = centre + space * p;
  return {curved ? bezier(std::move(points)) : polyline(std::move(points))};
}

Curves Generator::u_turn() {
  const TriangleIndex t = any_triangle();
  const auto c = sheet_.corners(t);
  const std::size_t k = random_.below(3);
  const Point2 along = c[(k + 1) % 3] - c[k], out = 1 / std::sqrt(squared_length(along)) * Point2{along.y, -along.x};
  Point2 turn = inside_triangle().first, d = random_.direction();
  const bool round = random_.below(3) == 0;
  if (i_ % 2 == 1) {  // just behind an edge; a round turn by more than what flattening may take off it
    constexpr double depths[] = {0.3, 0.1, 1e-2, 1e-4, 1e-6, 1e-9};
    const double depth = depths[random_.below(round ? 3 : 6)] * extent_.mean_edge;
    turn = c[k] + random_.between(0.2, 0.8) * along + depth * out;
    d = out + random_.between(-0.7, 0.7) * along;
    d = 1 / std::sqrt(squared_length(d)) * d;
  }
  const double length = random_.coin(0.3) ? 2 * sheet_.size() : random_.between(0.2, 3) * extent_.mean_edge;
  const Point2 side = random_.between(0.02, 0.2) * std::min(length, 3 * extent_.mean_edge) * Point2{-d.y, d.x};
  const Point2 a = turn - length * d - side, b = turn - length * d + side;
  if (round) return {bezier({a, a + length / 0.75 * d, b + length / 0.75 * d, b})};
  if (random_.coin()) return {polyline({a, turn, b})};
  return {polyline({a, turn - 0.3 * side, turn + 0.3 * side, b})};
}

Curves Generator::through_vertices() {
  Points points{sheet_.rest(any_vertex())};
  const std::size_t n = 2 + random_.below(3);
  while (points.size() < n) {
    const Point2 p = sheet_.rest(any_vertex());
    if (sheet_.vertex_count() <= 4 || std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
  const Point2 from = points[0], line = points[1] - from;
  switch (i_ % 5) {
    case 0:
      return {polyline({from - 0.5 * line, from + 2 * line})};
    case 1:
      return {polyline({from - sheet_.size() / extent_.mean_edge * line, points[1] + line})};
    case 2:
      return {bezier({from, onto_sheet(inside()), onto_sheet(inside()), points[1], 2 * points[1] - onto_sheet(inside()),
                      onto_sheet(inside()), onto_sheet(inside())})};
    case 3:
      if (n > 2) return {polyline(std::move(points), true)};
      [[fallthrough]];
    default:
      return {polyline(std::move(points))};
  }
}

std::vector<HalfEdge> outgoing(const Sheet& sheet, VertexIndex v) {
  std::vector<HalfEdge> all;
  for (const HalfEdge h : outgoing_edges(sheet, v)) all.push_back(h);
  return all;
}

/// Up to eight edges; straight on or bending, and not back. One in three runs along the border as far as it goes.
std::vector<VertexIndex> Generator::edge_chain() {
  std::vector<VertexIndex> chain{any_vertex()};
  const bool on_border = i_ % 3 == 1, straight = random_.coin();
  for (int tries = 0; on_border && tries < 1000 && !sheet_.on_border(sheet_.first_outgoing(chain[0])); ++tries)
    chain[0] = any_vertex();
  const std::size_t length = 1 + random_.below(8);
  while (chain.size() <= length) {
    const VertexIndex v = chain.back();
    const auto around = outgoing(sheet_, v);
    VertexIndex next = sheet_.target(on_border ? around.front() : around[random_.below(around.size())]);
    const auto turn = [&](VertexIndex w) {
      const Point2 a = sheet_.rest(v) - sheet_.rest(chain[chain.size() - 2]), b = sheet_.rest(w) - sheet_.rest(v);
      return dot(a, b) / std::sqrt(squared_length(a) * squared_length(b));
    };
    for (HalfEdge h : around)
      if (straight && !on_border && chain.size() > 1 && turn(sheet_.target(h)) > turn(next)) next = sheet_.target(h);
    if (chain.size() > 1 && next == chain[chain.size() - 2]) break;
    chain.push_back(next);
  }
  return chain;
}

Curves Generator::along_edges() {
  Points points;
  for (VertexIndex v : edge_chain()) points.push_back(sheet_.rest(v));
  const Point2 last = points.back(), step = last - points[points.size() - 2];
  switch (random_.below(4)) {
    case 0:
      points.back() = last - random_.between(0.2, 0.8) * step;
      break;  // ends inside an edge
    case 1:
      points.push_back(onto_sheet(inside()));
      break;
    case 2:
      points.insert(points.begin(), onto_sheet(inside()));
      break;
    default:
      break;
  }
  return {polyline(std::move(points))};
}

struct Family {
  const char* name;
  Curves (Generator::*make)();
};
constexpr Family family_table[] = {
    {"straight", &Generator::straight},       {"curved", &Generator::curved},
    {"partial", &Generator::partial},         {"border_inward", &Generator::border_inward},
    {"cut_out", &Generator::cut_out},         {"recut", &Generator::recut},
    {"several", &Generator::several},         {"self_crossing", &Generator::self_crossing},
    {"tiny_loop", &Generator::tiny_loop},     {"tiny_open", &Generator::tiny_open},
    {"u_turn", &Generator::u_turn},           {"through_vertices", &Generator::through_vertices},
    {"along_edges", &Generator::along_edges},
};

}  // namespace

SheetExtent extent_of(const Sheet& sheet) {
  SheetExtent extent{{1e300, 1e300}, {-1e300, -1e300}, sheet.mean_edge()};
  for (std::size_t i = 0; i < sheet.vertex_slots(); ++i) {
    if (!sheet.triangle_of_vertex(VertexIndex(i)).valid()) continue;
    const Point2 p = sheet.rest(VertexIndex(i));
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

std::span<const char* const> cut_families() {
  static const auto names = [] {
    std::array<const char*, std::size(family_table)> result{};
    std::transform(std::begin(family_table), std::end(family_table), result.begin(),
                   [](const Family& f) { return f.name; });
    return result;
  }();
  return names;
}

std::vector<Curve> make_case(const std::string& family, std::uint64_t seed, std::size_t i, const Sheet& sheet) {
  std::string known;
  for (const Family& f : family_table) {
    known += (known.empty() ? "" : ", ") + std::string(f.name);
    if (f.name != family) continue;
    std::uint64_t key = Random(seed).bits();
    for (char c : family) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    Generator generator(sheet, Random(key).bits() + i * 0xD1342543DE82EF95u, i);
    return (generator.*f.make)();
  }
  throw InputError("cut family '" + family + "' is unknown; choose one of " + known);
}

Curve make_small_cut(std::uint64_t seed, std::size_t i, const Sheet& sheet) {
  constexpr const char* kinds[] = {"straight", "curved", "partial", "border_inward", "cut_out", "self_crossing"};
  Random random(Random(seed).bits() + i * 0xD1342543DE82EF95u);
  Curve curve = make_case(kinds[random.below(std::size(kinds))], seed, i, sheet).front();
  const auto [low, high, h] = extent_of(sheet);
  Point2 least = curve.points.front(), most = least;
  for (Point2 p : curve.points) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double factor = random.between(0.1, 0.3) * side / std::max(most.x - least.x, most.y - least.y);
  const double u = random.unit(), v = random.unit();
  const Point2 centre{low.x + u * (high.x - low.x), low.y + v * (high.y - low.y)};
  const Point2 middle = 0.5 * (least + most);
  for (Point2& p : curve.points) p = centre + factor * (p - middle);
  if (curve.closed && curve.kind == Curve::Kind::bezier) curve.points.back() = curve.points.front();
  return curve;
}

}  // namespace cutbench
