// Cuts that lie as the sheet's triangles do: within one, round one, through vertices, along edges.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/cases/cut_generator.h"
#include "harness/mesh/one_ring.h"

namespace cutbench {

namespace {

std::vector<HalfEdge> outgoing(const Sheet& sheet, VertexIndex v) {
  std::vector<HalfEdge> all;
  for (const HalfEdge h : outgoing_edges(sheet, v)) all.push_back(h);
  return all;
}

}  // namespace

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

}  // namespace cutbench
