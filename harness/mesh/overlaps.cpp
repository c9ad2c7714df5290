#include "harness/mesh/overlaps.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Corners = std::array<Point2, 3>;
/// A triangle, or the border edge 3 t + k.
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;

class Search {
 public:
  explicit Search(const MeshData& mesh) : mesh_(mesh) {}

  std::optional<Overlap> run() {
    std::vector<Box> borders = border_boxes(), triangles;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) triangles.push_back(box(corners(t), t));
    CGAL::Bbox_2 all;
    for (const Box& b : borders) all += b.bbox();
    thin_ = overlap_tolerance * std::hypot(all.x_span(), all.y_span());
    CGAL::box_intersection_d(
        borders.begin(), borders.end(), triangles.begin(), triangles.end(),
        [this](const Box& border, const Box& triangle) { try_pair(border.info(), triangle.info()); });
    return first_ ? std::optional(Overlap{std::min(first_->first / 3, first_->second),
                                          std::max(first_->first / 3, first_->second), at(first_->first)})
                  : std::nullopt;
  }

 private:
  Point2 rest(std::int32_t v) const { return mesh_.rest[to_size(v)]; }
  Corners corners(std::size_t t) const {
    const auto [a, b, c] = mesh_.triangles[t];
    return {rest(a), rest(b), rest(c)};
  }
  std::array<Point2, 2> ends(std::size_t half_edge) const {
    const Corners c = corners(half_edge / 3);
    return {c[half_edge % 3], c[(half_edge + 1) % 3]};
  }
  Point2 at(std::size_t half_edge) const {
    const auto [a, b] = ends(half_edge);
    return 0.5 * (a + b);
  }

  template <class Points>
  static Box box(const Points& points, std::size_t info) {
    CGAL::Bbox_2 bounds;
    for (const Point2 p : points) bounds += CGAL::Bbox_2(p.x, p.y, p.x, p.y);
    return {bounds, info};
  }

  /// Of the half-edges that have no other one back, by numbers of vertices: the lips of incisions are borders.
  std::vector<Box> border_boxes() const {
    std::vector<std::tuple<std::int32_t, std::int32_t, std::size_t>> edges;
    for (std::size_t h = 0; h < 3 * mesh_.triangles.size(); ++h) {
      const auto& triangle = mesh_.triangles[h / 3];
      const auto [low, high] = std::minmax(triangle[h % 3], triangle[(h + 1) % 3]);
      edges.emplace_back(low, high, h);
    }
    std::sort(edges.begin(), edges.end());
    const auto same = [&](std::size_t i, std::size_t j) {
      return std::get<0>(edges[i]) == std::get<0>(edges[j]) && std::get<1>(edges[i]) == std::get<1>(edges[j]);
    };
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool twin = (i > 0 && same(i - 1, i)) || (i + 1 < edges.size() && same(i, i + 1));
      const std::size_t h = std::get<2>(edges[i]);
      if (!twin) boxes.push_back(box(ends(h), h));
    }
    return boxes;
  }

  void try_pair(std::size_t border, std::size_t t) {
    if (border / 3 == t || (first_ && *first_ <= std::pair(border, t))) return;
    if (overlaps(ends(border), corners(t))) first_ = {border, t};
  }

  /// The triangle left of the edge has area in common with `triangle`.
  bool overlaps(const std::array<Point2, 2>& edge, const Corners& triangle) const {
    const auto [p, q] = edge;
    std::array<int, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) side[k] = orientation(p, q, triangle[k]);
    const auto [low, high] = std::minmax_element(side.begin(), side.end());
    if (*high <= 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = triangle[k], b = triangle[(k + 1) % 3];
      if (side[k] == 0 && side[(k + 1) % 3] == 0) return runs_along(p, q, a, b);
      if (orientation(a, b, p) <= 0 && orientation(a, b, q) <= 0) return false;
    }
    return *low < 0 && depth(edge, triangle) > thin_;
  }

  /// Of two pieces of one line: they have more than a point in common.
  static bool runs_along(Point2 p, Point2 q, Point2 a, Point2 b) {
    const bool by_x = std::abs(q.x - p.x) >= std::abs(q.y - p.y);
    const auto along = [by_x](Point2 r) { return by_x ? r.x : r.y; };
    const double low = std::max(std::min(along(p), along(q)), std::min(along(a), along(b)));
    const double high = std::min(std::max(along(p), along(q)), std::max(along(a), along(b)));
    return low < high;
  }

  /// How far the middle of what of the edge lies in the triangle is from the triangle's sides.
  static double depth(const std::array<Point2, 2>& edge, const Corners& triangle) {
    const auto [p, q] = edge;
    double from = 0, to = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = triangle[k], side = triangle[(k + 1) % 3] - a;
      const double at_p = cross(side, p - a), at_q = cross(side, q - a);
      if (at_p < 0 && at_q > at_p) from = std::max(from, at_p / (at_p - at_q));
      if (at_q < 0 && at_p > at_q) to = std::min(to, at_p / (at_p - at_q));
    }
    const double half = (from + to) / 2;
    const Point2 middle = (1 - half) * p + half * q;
    double least = length(q - p);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = triangle[k], side = triangle[(k + 1) % 3] - a;
      least = std::min(least, cross(side, middle - a) / length(side));
    }
    return least;
  }

  const MeshData& mesh_;
  double thin_ = 0;
  std::optional<std::pair<std::size_t, std::size_t>> first_;  ///< border half-edge, triangle
};

}  // namespace

std::optional<Overlap> find_overlap(const MeshData& mesh) { return Search(mesh).run(); }

}  // namespace cutbench
