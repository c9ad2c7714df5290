#include "methods/phantom_node/phantom_node.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "harness/base/union_find.h"
#include "harness/mesh/locator.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/tolerances.h"
#include "methods/tools/divided.h"
#include "methods/tools/static_split.h"

namespace cutbench {

namespace {

class Doubling {
 public:
  Doubling(const Sheet& before, const Sheet& cut)
      : before_(before),
        cut_(cut),
        parent_(cut.triangle_slots()),
        parts_(cut.triangle_slots()),
        copies_(cut.deformed_slots() + 3 * cut.triangle_slots()) {
    find_parents();
    join_parts();
    join_copies();
  }

  Ties run(const PhantomNode::Options& options) {
    number_phantoms();
    Ties ties;
    ties.phantoms = phantoms_;
    if (options.lumped_mass) lump(ties.lumped);
    if (options.ghost > 0) add_ghosts(options.ghost, ties.ghosts);
    std::vector<std::uint8_t> seen(cut_.deformed_slots());
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i) {
      const TriangleIndex t(i);
      if (!cut_.triangle(t).alive()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const DeformedIndex d = cut_.triangle(t).deformed[k];
        if (std::exchange(seen[d()], 1)) continue;
        if (is_new(cut_.triangle(t).vertex[k]))
          ties.ties.push_back(tie_of(d, t));
        else if (const DeformedIndex one = unknown(d()); one != d)
          ties.ties.push_back({d, {one, one, one}, {1, 0, 0}});
      }
    }
    return ties;
  }

 private:
  bool is_new(VertexIndex v) const { return cut_.is_newer(v, before_); }

  void find_parents() {
    const Locator locator(before_);
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const TriangleIndex t(i);
      const Triangle& triangle = cut_.triangle(t);
      if (!triangle.alive()) continue;
      if (i < before_.triangle_slots() && before_.triangle(t).vertex == triangle.vertex) {
        parent_[i] = t;
        continue;
      }
      const auto c = cut_.corners(t);
      const Point2 centroid = 1.0 / 3 * (c[0] + c[1] + c[2]);
      parent_[i] = triangle_at(before_, locator.near(before_, centroid), centroid);
    }
  }

  /// The corner of t's parent that is vertex v; none where it isn't one.
  std::optional<std::size_t> corner_at(TriangleIndex t, VertexIndex v) const {
    const auto& corners = before_.triangle(parent_[t()]).vertex;
    const auto found = std::find(corners.begin(), corners.end(), v);
    if (found == corners.end()) return {};
    return static_cast<std::size_t>(found - corners.begin());
  }
  /// The number of what t's part has at a corner of its parent. Numbers of vertices come first.
  std::size_t copy(TriangleIndex t, std::size_t corner) {
    return cut_.deformed_slots() + 3 * parts_.find(t()) + corner;
  }

  template <class Visit>
  void for_each_joint(Visit visit) const {
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i)
      for (int k = 0; k < 3 && cut_.triangle(TriangleIndex(i)).alive(); ++k)
        if (const HalfEdge h = half_edge(TriangleIndex(i), k); !cut_.separates(h))
          visit(TriangleIndex(i), triangle_of(cut_.opposite(h)));
  }

  void join_parts() {
    for_each_joint([&](TriangleIndex t, TriangleIndex u) {
      if (parent_[t()] == parent_[u()]) parts_.join(t(), u());
    });
  }

  void join_copies() {
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i) {
      const TriangleIndex t(i);
      if (!cut_.triangle(t).alive()) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto corner = corner_at(t, cut_.triangle(t).vertex[k]))
          copies_.join(copy(t, *corner), cut_.triangle(t).deformed[k]());
    }
    for_each_joint([&](TriangleIndex t, TriangleIndex u) {
      if (parent_[t()] == parent_[u()]) return;
      const auto& corners = before_.triangle(parent_[t()]).vertex;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto other = corner_at(u, corners[k])) copies_.join(copy(t, k), copy(u, *other));
    });
  }

  void number_phantoms() {
    phantom_.assign(3 * cut_.triangle_slots(), -1);
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i) {
      if (!cut_.triangle(TriangleIndex(i)).alive()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t one = copies_.find(copy(TriangleIndex(i), k));
        if (one < cut_.deformed_slots()) continue;
        if (auto& number = phantom_[one - cut_.deformed_slots()]; number < 0)
          number = static_cast<std::int32_t>(phantoms_++);
      }
    }
  }

  /// A third of the mass of each part to each copy of its parent's corners.
  void lump(std::vector<double>& lumped) {
    lumped.assign(cut_.deformed_slots() + phantoms_, 0);
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i) {
      const TriangleIndex t(i);
      if (!cut_.triangle(t).alive()) continue;
      const auto c = cut_.corners(t);
      for (std::size_t k = 0; k < 3; ++k)
        lumped[unknown(copy(t, k))()] += std::max(0.0, cross(c[1] - c[0], c[2] - c[0])) / 6;
    }
  }

  /// Across every edge of the sheet at which two parts are joined, one of them of a divided parent.
  void add_ghosts(double factor, std::vector<GhostEdge>& ghosts) {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> first_part(before_.triangle_slots(), none);
    std::vector<std::uint8_t> divided(before_.triangle_slots());
    for (std::size_t i = 0; i < cut_.triangle_slots(); ++i) {
      if (!cut_.triangle(TriangleIndex(i)).alive()) continue;
      std::size_t& first = first_part[parent_[i]()];
      if (first == none) first = parts_.find(i);
      divided[parent_[i]()] |= first != parts_.find(i);
    }
    std::set<std::pair<std::size_t, std::size_t>> done;
    for_each_joint([&](TriangleIndex t, TriangleIndex u) {
      const TriangleIndex p = parent_[t()], q = parent_[u()];
      if (p == q || !(divided[p()] || divided[q()])) return;
      if (!done.insert(std::minmax(parts_.find(t()), parts_.find(u()))).second) return;
      const auto& corners = before_.triangle(p).vertex;
      for (std::size_t k = 0; k < 3; ++k)  // the corner of p opposite the edge that both have
        if (!corner_at(u, corners[k]) && corner_at(u, corners[(k + 1) % 3]) && corner_at(u, corners[(k + 2) % 3]))
          ghosts.push_back(ghost_across(t, u, k, factor));
    });
  }

  GhostEdge ghost_across(TriangleIndex t, TriangleIndex u, std::size_t k, double factor) {
    const auto c = before_.corners(parent_[t()]), d = before_.corners(parent_[u()]);
    const Point2 a = c[(k + 1) % 3], edge = c[(k + 2) % 3] - a;
    const double length = std::sqrt(squared_length(edge));
    // A field that is 1 at the corner k alone has the slope 1 / height there, along the normal into the triangle; at
    // the ends of the edge it is what makes the field of all three constant.
    const auto& across = before_.triangle(parent_[u()]).vertex;
    std::size_t far = 0;
    while (corner_at(t, across[far])) ++far;
    const double slope_c = length / cross(edge, c[k] - a), slope_d = length / cross(edge, d[far] - a);  // signed
    const double foot_c = dot(c[k] - a, edge) / (length * length), foot_d = dot(d[far] - a, edge) / (length * length);
    GhostEdge ghost;
    ghost.unknown = {unknown(copy(t, k)), unknown(copy(t, (k + 1) % 3)), unknown(copy(t, (k + 2) % 3)),
                     unknown(copy(u, far))};
    ghost.jump = {slope_c, (foot_c - 1) * slope_c - (foot_d - 1) * slope_d, foot_d * slope_d - foot_c * slope_c,
                  -slope_d};
    ghost.stiffness = factor * length * length, ghost.mass = ghost.stiffness * length * length;
    return ghost;
  }

  DeformedIndex unknown(std::size_t number) {
    const std::size_t one = copies_.find(number), vertices = cut_.deformed_slots();
    return DeformedIndex(one < vertices ? one : vertices + static_cast<std::size_t>(phantom_[one - vertices]));
  }

  Tie tie_of(DeformedIndex d, TriangleIndex t) {
    const Point2 p = cut_.rest(cut_.rest_vertex(d));
    const auto c = before_.corners(parent_[t()]);
    const double twice = cross(c[1] - c[0], c[2] - c[0]);
    Tie tie{d, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      tie.masters[k] = unknown(copy(t, k));
      const Point2 from = c[(k + 1) % 3], to = c[(k + 2) % 3];
      const double area = cross(from - p, to - p);
      // A path that is no farther from an edge goes along it, so this is the rounding of a crossing.
      const bool on_edge = std::abs(area) <= rounding_tolerance * before_.snap() * std::sqrt(squared_length(to - from));
      tie.weights[k] = on_edge ? 0 : area / twice;
    }
    *std::max_element(tie.weights.begin(), tie.weights.end()) += 1 - (tie.weights[0] + tie.weights[1] + tie.weights[2]);
    return tie;
  }

  const Sheet &before_, &cut_;
  std::vector<TriangleIndex> parent_;  // per triangle
  UnionFind parts_;                    // of triangles of one parent
  UnionFind copies_;                   // of vertices, and three for the corners of the parent of each part
  std::vector<std::int32_t> phantom_;  // per copy that is no vertex: its number
  std::size_t phantoms_ = 0;
};

}  // namespace

void PhantomNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Ties PhantomNode::ties(const Sheet& before, const Sheet& cut) const { return Doubling(before, cut).run(options_); }

}  // namespace cutbench
