#include "harness/path/seams.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"

namespace cutbench {

namespace {

/// The vertices in use, those at one position in space one after the other.
std::vector<DeformedIndex> by_position(const Sheet& sheet) {
  std::vector<char> used(sheet.deformed_slots(), 0);
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive())
      for (const DeformedIndex d : sheet.triangle(TriangleIndex(t)).deformed) used[d()] = 1;
  std::vector<DeformedIndex> vertices;
  for (std::size_t d = 0; d < used.size(); ++d)
    if (used[d] != 0) vertices.emplace_back(d);
  const auto key = [&](DeformedIndex d) {
    const Point3 p = sheet.position(d);
    return std::tuple(p.x, p.y, p.z, d());
  };
  std::sort(vertices.begin(), vertices.end(), [&](DeformedIndex a, DeformedIndex b) { return key(a) < key(b); });
  return vertices;
}

/// Pairs of vertices that a seam joins.
std::vector<std::pair<std::size_t, std::size_t>> seam_pairs(const Sheet& sheet) {
  const std::vector<DeformedIndex> vertices = by_position(sheet);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const DeformedIndex a = vertices[i - 1], b = vertices[i];
    if (sheet.position(a) == sheet.position(b) && sheet.rest(sheet.rest_vertex(a)) != sheet.rest(sheet.rest_vertex(b)))
      pairs.emplace_back(a(), b());
  }
  return pairs;
}

std::vector<std::size_t> classes(UnionFind& joined, std::size_t count) {
  std::vector<std::size_t> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = joined.find(i);
  return result;
}

}  // namespace

Seams::Seams(const Sheet& posed) {
  const auto pairs = seam_pairs(posed);
  if (pairs.empty()) return;
  const std::size_t count = posed.deformed_slots();
  vertices_.resize(posed.triangle_slots());
  corners_.resize(posed.triangle_slots());
  ways_.resize(count);
  UnionFind joined(count);
  for (std::size_t i = 0; i < posed.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!posed.triangle(t).alive()) continue;
    const auto& d = posed.triangle(t).deformed;
    const auto& v = vertices_[i] = {d[0](), d[1](), d[2]()};
    const auto& p = corners_[i] = posed.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const double edge = length(p[l] - p[k]);
      ways_[v[k]].push_back({v[l], edge});
      ways_[v[l]].push_back({v[k], edge});
      joined.join(v[k], v[l]);
    }
  }
  panel_ = classes(joined, count);
  for (const auto& [a, b] : pairs) {
    ways_[a].push_back({b, 0});
    ways_[b].push_back({a, 0});
    joined.join(a, b);
  }
  sewn_panels_ = classes(joined, count);
}

bool Seams::lies_between(const PlaceAtRest& a, const PlaceAtRest& b) const {
  if (ways_.empty() || a.triangle == b.triangle) return false;
  const std::size_t v = vertices_[a.triangle()][0], w = vertices_[b.triangle()][0];
  if (sewn_panels_[v] != sewn_panels_[w]) return false;
  if (panel_[v] != panel_[w]) return true;
  constexpr double rounding = 1e-9;
  return shortest_way(a, b) < (1 - rounding) * length(b.point - a.point);
}

/// From a to the corners of its triangle, along edges (Dijkstra 1959), and from the corners of b's to b.
double Seams::shortest_way(const PlaceAtRest& a, const PlaceAtRest& b) const {
  using Entry = std::pair<double, std::size_t>;  // length of the way, vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<double> shortest(ways_.size(), std::numeric_limits<double>::infinity());
  const auto reach = [&](std::size_t vertex, double way) {
    if (way >= shortest[vertex]) return;
    shortest[vertex] = way;
    open.emplace(way, vertex);
  };
  const auto &from = vertices_[a.triangle()], &to = vertices_[b.triangle()];
  const auto &begins = corners_[a.triangle()], &ends = corners_[b.triangle()];
  for (std::size_t k = 0; k < 3; ++k) reach(from[k], length(begins[k] - a.point));
  while (!open.empty()) {
    const auto [way, vertex] = open.top();
    open.pop();
    if (way > shortest[vertex]) continue;
    for (const Way& next : ways_[vertex]) reach(next.to, way + next.length);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) least = std::min(least, shortest[to[k]] + length(ends[k] - b.point));
  return least;
}

}  // namespace cutbench
