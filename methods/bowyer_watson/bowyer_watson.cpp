#include "methods/bowyer_watson/bowyer_watson.h"

#include <algorithm>
#include <array>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"

namespace cutbench {

namespace {

using Edge = std::array<int, 2>;

Point2 at(const Patch& patch, int p) { return patch.points[to_size(p)]; }

/// Inserts one point: the cavity of triangles whose circumcircle holds it becomes a fan round it.
class Insertion {
 public:
  Insertion(Patch& patch, int p) : patch_(patch), p_(p), in_cavity_(patch.triangles.size()) {}

  void run() {
    seed();
    grow();
    while (!star_shaped()) {
    }
    std::vector<std::array<int, 3>> kept;
    for (std::size_t t = 0; t < patch_.triangles.size(); ++t)
      if (!in_cavity_[t]) kept.push_back(patch_.triangles[t]);
    for (const auto& [a, b] : rim_) kept.push_back({a, b, p_});
    patch_.triangles = std::move(kept);
  }

 private:
  enum : std::uint8_t { outside = 0, member = 1, holds_point = 2, banned = 3 };

  bool inserted(int q) const {
    return std::any_of(patch_.triangles.begin(), patch_.triangles.end(),
                       [&](const auto& t) { return t[0] == q || t[1] == q || t[2] == q; });
  }

  /// The triangles that the point lies in: the one behind the ring edge it splits, or that which holds it.
  void seed() {
    const int position = patch_.ring_position[to_size(p_)], n = to_int(patch_.ring.size());
    if (position >= 0) {
      int before = position, after = position;
      do before = (before + n - 1) % n;
      while (!inserted(patch_.ring[to_size(before)]));
      do after = (after + 1) % n;
      while (!inserted(patch_.ring[to_size(after)]));
      split_ = {patch_.ring[to_size(before)], patch_.ring[to_size(after)]};
      const PatchEdge side = find_edge(patch_, split_[0], split_[1]);
      if (side.triangle >= 0) in_cavity_[to_size(side.triangle)] = holds_point;
      return;
    }
    for (std::size_t t = 0; t < patch_.triangles.size(); ++t) {
      const auto [a, b, c] = patch_.triangles[t];
      const Point2 p = at(patch_, p_), x = at(patch_, a), y = at(patch_, b), z = at(patch_, c);
      if (orientation(x, y, p) >= 0 && orientation(y, z, p) >= 0 && orientation(z, x, p) >= 0)
        in_cavity_[t] = holds_point;
    }
  }

  bool circle_holds_point(std::size_t t) const {
    const auto [a, b, c] = patch_.triangles[t];
    return in_circle(at(patch_, a), at(patch_, b), at(patch_, c), at(patch_, p_)) > 0;
  }

  void grow() {
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t t = 0; t < patch_.triangles.size(); ++t) {
        if (in_cavity_[t] != outside || !touches_cavity(t) || !circle_holds_point(t)) continue;
        in_cavity_[t] = member;
        grown = true;
      }
    }
  }

  bool is_in(int t) const {
    return t >= 0 && (in_cavity_[to_size(t)] == member || in_cavity_[to_size(t)] == holds_point);
  }

  bool touches_cavity(std::size_t t) const {
    const auto [a, b, c] = patch_.triangles[t];
    return is_in(find_edge(patch_, b, a).triangle) || is_in(find_edge(patch_, c, b).triangle) ||
           is_in(find_edge(patch_, a, c).triangle);
  }

  /// Collects the rim. Where an edge of it is not visible from the point (rounded points on the ring), the cavity is
  /// corrected, and the answer is no.
  bool star_shaped() {
    rim_.clear();
    for (std::size_t t = 0; t < patch_.triangles.size(); ++t) {
      if (!is_in(to_int(t))) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = patch_.triangles[t][k], b = patch_.triangles[t][k == 2 ? 0 : k + 1];
        const int beyond = find_edge(patch_, b, a).triangle;
        if (is_in(beyond) || (a == split_[0] && b == split_[1])) continue;
        if (orientation(at(patch_, a), at(patch_, b), at(patch_, p_)) > 0) {
          rim_.push_back({a, b});
          continue;
        }
        if (in_cavity_[t] == member) {
          in_cavity_[t] = banned;
        } else if (beyond >= 0 && in_cavity_[to_size(beyond)] == outside) {
          in_cavity_[to_size(beyond)] = holds_point;
        } else {
          throw TooClose("a point of the path fell out of its triangle: coordinates too close for doubles");
        }
        return false;
      }
    }
    return true;
  }

  Patch& patch_;
  int p_;
  std::vector<std::uint8_t> in_cavity_;
  Edge split_{-1, -1};
  std::vector<Edge> rim_;
};

}  // namespace

int triangulate_delaunay(Patch& patch) {
  start_triangulation(patch);
  for (int p : patch.path_order) Insertion(patch, p).run();
  return recover_segments(patch);
}

void BowyerWatson::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  embed_patches(sheet, trace, patch_work_, is_diagonal_from_p_delaunay,
                [&](Patch& patch) { notes.recovered_segments += triangulate_delaunay(patch); });
}

namespace {

/// Points p and q on the two edges before and behind corner `shortest` + 2 leave three positive triangles, whichever
/// diagonal is chosen.
bool leaves_room(const std::array<Point2, 3>& corner, int shortest, Point2 p, Point2 q) {
  const Point2 a = corner[to_size(shortest)];
  const Point2 b = corner[to_size(next_corner(shortest))];
  const Point2 apex = corner[to_size(previous_corner(shortest))];
  return orientation(apex, q, p) > 0 && orientation(a, b, p) > 0 && orientation(a, p, q) > 0 &&
         orientation(a, b, q) > 0 && orientation(b, p, q) > 0;
}

}  // namespace

/// Puts midpoints on the two longest edges of t, where that is possible in doubles.
void BowyerWatson::split_long_edges(const Sheet& sheet, TriangleIndex t) {
  const auto corner = sheet.corners(t);
  const auto squared = [&](int k) { return squared_length(corner[to_size(next_corner(k))] - corner[to_size(k)]); };
  int shortest = 0;
  for (int k : {1, 2})
    if (squared(k) < squared(shortest)) shortest = k;
  const double floor = 2 * options_.min_edge * sheet.mean_edge();
  for (int k : {next_corner(shortest), previous_corner(shortest)}) {
    if (squared(k) < floor * floor) continue;
    Place place;
    place.kind = Place::Kind::edge;
    place.edge = first_half_edge(sheet, half_edge(t, k));
    place.lambda = 0.5;
    const Point2 a = sheet.rest(sheet.origin(place.edge)), b = sheet.rest(sheet.target(place.edge));
    place.point = 0.5 * a + 0.5 * b;
    const auto halves_stay_positive = [&](HalfEdge h) {
      if (!h.valid()) return true;
      const Point2 apex = sheet.rest(sheet.origin(Sheet::previous(h)));
      return orientation(sheet.rest(sheet.origin(h)), place.point, apex) > 0 &&
             orientation(place.point, sheet.rest(sheet.target(h)), apex) > 0;
    };
    if (!halves_stay_positive(place.edge) || !halves_stay_positive(sheet.opposite(place.edge))) continue;
    if (midpoints_.nodes.empty() || leaves_room(corner, shortest, midpoints_.node(0).place.point, place.point))
      midpoints_.node_of(place);
  }
}

void BowyerWatson::improve(Sheet& sheet, MethodNotes& notes) {
  const auto is_ill_shaped = [&](TriangleIndex t) {
    const auto c = sheet.corners(t);
    return sheet.triangle(t).alive() && aspect_ratio(c[0], c[1], c[2]) > options_.max_aspect;
  };
  const std::size_t embedded = sheet.log().new_vertices.size();
  for (int round = 0; round < options_.rounds; ++round) {
    ill_shaped_.clear();
    for_each_changed(sheet, [&](TriangleIndex t) {
      if (is_ill_shaped(t)) ill_shaped_.push_back(t);
    });
    for (auto t : ill_shaped_) {
      if (sheet.log().new_vertices.size() > options_.most_vertices) {
        notes.stopped_early = true;
        notes.improved_nothing = sheet.log().new_vertices.size() == embedded;
        return;
      }
      if (!is_ill_shaped(t)) continue;  // a neighbour's split has improved it
      midpoints_.reset(sheet);
      split_long_edges(sheet, t);
      // The triangle itself has two points or one, its neighbours one each: bisected, there is no choice.
      if (!midpoints_.nodes.empty())
        embed_patches(sheet, midpoints_, patch_work_, is_diagonal_from_p_delaunay, triangulate_delaunay);
    }
  }
}

}  // namespace cutbench
