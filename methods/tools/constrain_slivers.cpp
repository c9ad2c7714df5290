#include "methods/tools/constrain_slivers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "harness/base/conversions.h"
#include "methods/tools/creases.h"
#include "methods/tools/divided.h"

namespace cutbench {

namespace {

/// The vertices of the triangles that the last cut made or changed.
class ChangedPlaces {
 public:
  explicit ChangedPlaces(const Sheet& cut) : cut_(cut) {
    for (const auto& touched : cut.log().touched) add(touched.slot);
    for (std::size_t t = cut.log().triangles_before; t < cut.triangle_slots(); ++t) add(TriangleIndex(t));
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const DeformedIndex d : vertices_) places_.push_back(cut.rest(cut.rest_vertex(d)));
    std::sort(places_.begin(), places_.end(), [](Point2 a, Point2 b) { return a.x < b.x; });
  }
  const std::vector<DeformedIndex>& vertices() const { return vertices_; }
  bool holds(DeformedIndex d) const { return std::binary_search(vertices_.begin(), vertices_.end(), d); }
  bool reaches(Point2 p, double distance) const {
    const auto first = std::lower_bound(places_.begin(), places_.end(), p.x - distance,
                                        [](Point2 place, double x) { return place.x < x; });
    for (auto place = first; place != places_.end() && place->x <= p.x + distance; ++place)
      if (length(*place - p) < distance) return true;
    return false;
  }

 private:
  void add(TriangleIndex t) {
    if (!cut_.triangle(t).alive()) return;
    for (const DeformedIndex d : cut_.triangle(t).deformed) vertices_.push_back(d);
  }
  const Sheet& cut_;
  std::vector<DeformedIndex> vertices_;  // in rising order
  std::vector<Point2> places_;           // by rising x
};

/// The constraints of one cut sheet.
class SliverConstraints {
 public:
  SliverConstraints(const Sheet& before, const Sheet& cut, double thinness)
      : sheet_(cut),
        thinness_(thinness),
        before_(before),
        longest_(cut.vertex_slots()),
        number_(cut.deformed_slots(), -1),
        kept_(cut.deformed_slots()) {}

  /// Of all vertices that cuts made.
  void choose_among(const std::vector<TriangleIndex>& triangles) {
    for (const TriangleIndex t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (is_new(triangle(t).vertex[k])) corners_.push_back({triangle(t).deformed[k], t, k});
  }
  /// Of those that the last cut may have changed. All others stay.
  void choose_after(const Constraints& last) {
    const ChangedPlaces changed(sheet_);
    std::vector<DeformedIndex> vertices;
    for (const DeformedIndex d : changed.vertices())
      if (is_new(sheet_.rest_vertex(d))) vertices.push_back(d);
    for (const Constraint& constraint : last.constraints) {
      if (changed.holds(constraint.vertex)) continue;  // it is among these already
      const bool stays = std::none_of(constraint.masters.begin(), constraint.masters.end(),
                                      [&](DeformedIndex d) { return changed.holds(d); }) &&
                         !changed.reaches(place(constraint.vertex), constraint.reach);
      stays ? keep(constraint) : vertices.push_back(constraint.vertex);
    }
    for (const DeformedIndex d : vertices)
      for_each_round(sheet_.rest_vertex(d), [&](HalfEdge h) {
        if (triangle(triangle_of(h)).deformed[to_size(corner_of(h))] == d)
          corners_.push_back({d, triangle_of(h), to_size(corner_of(h))});
      });
  }

  Constraints run() {
    collect();
    choose_free();
    Constraints constraints = std::move(kept_constraints_);
    for (const New& v : new_)
      if (!is_free(v.vertex))
        if (const auto constraint = constraint_of(v)) constraints.constraints.push_back(*constraint);
    return constraints;
  }

 private:
  /// Corner of a triangle at a vertex that cuts made.
  struct Corner {
    DeformedIndex vertex;
    TriangleIndex triangle;
    std::size_t corner;
  };
  /// A vertex that cuts made, and where its corners are.
  struct New {
    DeformedIndex vertex;
    std::size_t begin, end;
    bool tip;
    double scale;                            ///< L, of the triangles round it
    double altitude;                         ///< the smallest, over L of its triangle
    DeformedIndex stands_for = {};           ///< itself where it is free, the nearest free one where it is constrained
    std::array<DeformedIndex, 2> flat = {};  ///< the edge that it is too near to, where it is constrained for that
  };

  /// An old constraint: its vertex stands for the nearest of its masters, as when it was found.
  void keep(const Constraint& constraint) {
    const Point2 p = place(constraint.vertex);
    kept_[constraint.vertex()] = *std::min_element(
        constraint.masters.begin(), constraint.masters.end(),
        [&](DeformedIndex a, DeformedIndex b) { return squared_length(place(a) - p) < squared_length(place(b) - p); });
    kept_constraints_.constraints.push_back(constraint);
  }

  bool is_new(VertexIndex v) const { return sheet_.is_newer(v, before_); }
  const Triangle& triangle(TriangleIndex t) const { return sheet_.triangle(t); }

  static double twice_area(const std::array<Point2, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); }
  static double edge(const std::array<Point2, 3>& c, std::size_t k) { return length(c[(k + 1) % 3] - c[k]); }
  /// Of corner k, over the edge opposite to it.
  static double altitude(const std::array<Point2, 3>& c, std::size_t k) { return twice_area(c) / edge(c, (k + 1) % 3); }

  /// L of a triangle.
  double scale(TriangleIndex t) {
    const auto& v = triangle(t).vertex;
    return std::max({longest(v[0]), longest(v[1]), longest(v[2])});
  }

  /// Edge of the triangles round a vertex.
  double longest(VertexIndex v) {
    double& longest = longest_[v()];
    if (longest > 0) return longest;
    for_each_round(v, [&](HalfEdge h) {
      const auto corners = sheet_.corners(triangle_of(h));
      longest = std::max({longest, edge(corners, 0), edge(corners, 1), edge(corners, 2)});
    });
    return longest;
  }

  template <class Visit>
  void for_each_round(VertexIndex v, Visit visit) const {
    const HalfEdge first = sheet_.first_outgoing(v);
    HalfEdge h = first;
    do visit(h);
    while ((h = sheet_.next_outgoing(h)).valid() && h != first);
  }

  bool has_one_copy(DeformedIndex d) const {
    bool one = true;
    for_each_round(sheet_.rest_vertex(d),
                   [&](HalfEdge h) { one &= triangle(triangle_of(h)).deformed[to_size(corner_of(h))] == d; });
    return one;
  }

  void collect() {
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
      return std::tuple(a.vertex, a.triangle) < std::tuple(b.vertex, b.triangle);
    });
    for (std::size_t begin = 0, end; begin < corners_.size(); begin = end) {
      const DeformedIndex d = corners_[begin].vertex;
      double smallest = std::numeric_limits<double>::infinity(), largest_scale = 0;
      for (end = begin; end < corners_.size() && corners_[end].vertex == d; ++end) {
        const TriangleIndex t = corners_[end].triangle;
        smallest = std::min(smallest, altitude(sheet_.corners(t), corners_[end].corner) / scale(t));
        largest_scale = std::max(largest_scale, scale(t));
      }
      new_.push_back({d, begin, end, has_one_copy(d), largest_scale, smallest});
    }
  }

  void choose_free() {
    std::sort(new_.begin(), new_.end(), [](const New& a, const New& b) {
      return std::tuple(!a.tip, -a.altitude, a.vertex) < std::tuple(!b.tip, -b.altitude, b.vertex);
    });
    for (std::size_t i = 0; i < new_.size(); ++i) number_[new_[i].vertex()] = to_int32(i);
    for (New& v : new_) {
      const DeformedIndex nearest = nearest_free(v);
      v.stands_for = nearest.valid() ? nearest : v.vertex;
    }
    for (auto v = new_.rbegin(); v != new_.rend(); ++v)
      if (is_free(v->vertex)) flatten(*v);
    for (New& v : new_) {
      if (is_free(v.vertex)) continue;
      if (const DeformedIndex nearest = nearest_free(v); nearest.valid()) v.stands_for = nearest;
      v.stands_for = free_for(v.stands_for);
    }
  }

  /// Nothing for old vertices.
  const New* find_new(DeformedIndex d) const {
    const std::int32_t number = number_[d()];
    return number >= 0 ? &new_[to_size(number)] : nullptr;
  }
  DeformedIndex stand_in(DeformedIndex d) const {
    const New* const v = find_new(d);
    return v ? v->stands_for : kept_[d()].valid() ? kept_[d()] : d;
  }
  bool is_free(DeformedIndex d) const { return stand_in(d) == d; }
  /// What stands for d, by way of what has been constrained itself since.
  DeformedIndex free_for(DeformedIndex d) const {
    while (!is_free(d)) d = stand_in(d);
    return d;
  }
  Point2 place(DeformedIndex d) const { return sheet_.rest(sheet_.rest_vertex(d)); }

  /// The nearest free vertex within a short way of edges.
  DeformedIndex nearest_free(const New& v) {
    const Point2 p = place(v.vertex);
    DeformedIndex nearest;
    double distance = thinness_ * v.scale;
    near_.assign(1, v.vertex);
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const New& other = *find_new(near_[i]);
      for (std::size_t j = other.begin; j < other.end; ++j)
        for (const DeformedIndex d : triangle(corners_[j].triangle).deformed) {
          const double away = length(place(d) - p);
          if (d == v.vertex || away >= thinness_ * v.scale) continue;
          if (is_free(d) && away < distance) {
            nearest = d;
            distance = away;
          }
          if (find_new(d) && std::find(near_.begin(), near_.end(), d) == near_.end()) near_.push_back(d);
        }
    }
    return nearest;
  }

  bool is_stiff(const std::array<Point2, 3>& corners, std::size_t k, TriangleIndex t) {
    return altitude(corners, k) < thinness_ * scale(t);
  }

  /// Constraints a free vertex that is too near to an edge, as it is when corners constrained to a near one are drawn
  /// to it, unless a corner there has been constrained for that vertex's sake.
  void flatten(New& v) {
    double thinnest = thinness_;
    DeformedIndex nearer;
    for (std::size_t i = v.begin; i < v.end; ++i) {
      const DeformedIndex d = corners_[i].vertex;
      const TriangleIndex t = corners_[i].triangle;
      const std::size_t corner = corners_[i].corner;
      std::array<DeformedIndex, 3> drawn;
      std::array<Point2, 3> c;
      draw(t, drawn, c);
      for (std::size_t k = 0; k < 3; ++k)
        if (const DeformedIndex own = triangle(t).deformed[k]; flat(own)[0].valid()) c[k] = place(own);
      const std::size_t next = (corner + 1) % 3, last = (corner + 2) % 3;
      if (drawn[next] == drawn[last] || drawn[next] == d || drawn[last] == d) continue;
      const double height = std::abs(altitude(c, corner)) / scale(t);
      if (height >= thinnest) continue;
      const auto yields = [&](std::size_t k) {
        const auto edge = flat(triangle(t).deformed[k]);
        return edge[0] == d || edge[1] == d;
      };
      if (yields(next) || yields(last)) continue;
      thinnest = height;
      v.flat = {drawn[next], drawn[last]};
      const bool next_is_nearer = squared_length(c[next] - c[corner]) < squared_length(c[last] - c[corner]);
      nearer = next_is_nearer ? drawn[next] : drawn[last];
    }
    if (nearer.valid()) v.stands_for = nearer;
  }

  std::array<DeformedIndex, 2> flat(DeformedIndex d) const {
    const New* const v = find_new(d);
    return v ? v->flat : std::array<DeformedIndex, 2>{};
  }

  void draw(TriangleIndex t, std::array<DeformedIndex, 3>& drawn, std::array<Point2, 3>& corners) const {
    for (std::size_t k = 0; k < 3; ++k) {
      drawn[k] = free_for(triangle(t).deformed[k]);
      corners[k] = place(drawn[k]);
    }
  }

  /// What the vertex may not move against: what stands for it, and for the other stiff corners of its thinnest
  /// triangle.
  void find_companions(const New& v) {
    companions_.assign(1, v.stands_for);
    if (v.flat[0].valid()) {
      for (const DeformedIndex d : v.flat)
        if (stand_in(d) != companions_[0]) companions_.push_back(stand_in(d));
      return;
    }
    double thinnest = std::numeric_limits<double>::infinity();
    for (std::size_t i = v.begin; i < v.end; ++i) {
      const auto& [d, t, corner] = corners_[i];
      const auto corners = sheet_.corners(t);
      if (altitude(corners, corner) / scale(t) >= thinnest) continue;
      thinnest = altitude(corners, corner) / scale(t);
      companions_.resize(1);
      for (std::size_t k = 0; k < 3; ++k)
        if (const DeformedIndex other = stand_in(triangle(t).deformed[k]);
            k != corner && other != companions_[0] && is_stiff(corners, k, t))
          companions_.push_back(other);
    }
  }

  /// The triangle when constrained vertices are drawn to those that stand for them; false where it is no good one then.
  bool lead(TriangleIndex t, std::array<DeformedIndex, 3>& masters, std::array<Point2, 3>& corners) {
    draw(t, masters, corners);
    const double longest = std::max({edge(corners, 0), edge(corners, 1), edge(corners, 2)});
    return longest > 0 && twice_area(corners) >= thinness_ * scale(t) * longest;
  }

  std::optional<Constraint> constraint_of(const New& made) {
    const Point2 p = place(made.vertex);
    find_companions(made);
    seen_.clear();
    const auto reach = [&](TriangleIndex t) {
      if (std::find(seen_.begin(), seen_.end(), t) == seen_.end()) seen_.push_back(t);
    };
    for (std::size_t i = made.begin; i < made.end; ++i) reach(corners_[i].triangle);
    std::pair best{std::ptrdiff_t{0}, 0.0};
    std::optional<Constraint> constraint;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      std::array<DeformedIndex, 3> masters;
      std::array<Point2, 3> c;
      if (lead(seen_[i], masters, c)) {
        const auto met = std::count_if(companions_.begin(), companions_.end(), [&](DeformedIndex d) {
          return std::find(masters.begin(), masters.end(), d) != masters.end();
        });
        const double twice = twice_area(c);
        std::array<double, 3> weights{0, cross(c[2] - p, c[0] - p) / twice, cross(c[0] - p, c[1] - p) / twice};
        weights[0] = 1 - weights[1] - weights[2];
        const std::pair score{met, *std::min_element(weights.begin(), weights.end())};
        if (met > 0 && (!constraint || score > best) && is_at_rest(sheet_, made.vertex, masters, weights)) {
          best = score;
          constraint = Constraint{made.vertex, masters, weights, made.scale};
        }
      }
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(seen_[i], k);
        if (sheet_.separates(h)) continue;
        const TriangleIndex beyond = triangle_of(sheet_.opposite(h));
        const auto corners = sheet_.corners(beyond);
        if (std::any_of(corners.begin(), corners.end(), [&](Point2 q) { return length(q - p) < made.scale; }))
          reach(beyond);
      }
    }
    return constraint;
  }

  const Sheet& sheet_;
  double thinness_;
  const Sheet& before_;
  // Filling these three is all that takes the longer, the larger the sheet is.
  std::vector<double> longest_;       // per vertex; 0: not asked for yet
  std::vector<std::int32_t> number_;  // in new_, per vertex of the opened sheet; -1 for old ones
  std::vector<DeformedIndex> kept_;   // per vertex of the opened sheet: what stands for it since before the last cut
  Constraints kept_constraints_;
  std::vector<Corner> corners_;      // by vertex
  std::vector<New> new_;             // in the order in which they are made free
  std::vector<TriangleIndex> seen_;  // working storage, as the next two
  std::vector<DeformedIndex> near_, companions_;
};

}  // namespace

Constraints constrain_slivers(const Sheet& before, const Sheet& cut, double thinness, bool only_divided) {
  SliverConstraints all(before, cut, thinness);
  all.choose_among(new_triangles(before, cut, only_divided));
  return all.run();
}

Constraints constrain_new_slivers(const Sheet& before, const Sheet& cut, double thinness, const Constraints& last) {
  SliverConstraints all(before, cut, thinness);
  all.choose_after(last);
  return all.run();
}

}  // namespace cutbench
