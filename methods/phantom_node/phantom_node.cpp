#include "methods/phantom_node/phantom_node.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/tolerances.h"
#include "methods/phantom_node/open_tips.h"
#include "methods/phantom_node/parts.h"
#include "methods/tools/static_split.h"

namespace cutbench {

namespace {

class Doubling {
 public:
  Doubling(const Sheet& before, const Sheet& cut, const PhantomNode::Options& options)
      : options_(options), parts_(before, cut), tips_(parts_, options.mass == PhantomNode::Mass::lumped), cut_(cut) {
    join_copies();
  }

  Constraints run() {
    number_phantoms();
    Constraints constraints;
    constraints.phantoms = phantoms_;
    if (options_.ghost > 0) add_ghosts(options_.ghost, constraints.ghosts);
    std::vector<std::uint8_t> seen(parts_.vertices().size());
    // The slit parts last: where a lip enters one, it goes along with the part that it comes from.
    for (const bool slit : {false, true})
      for (std::size_t i = 0; i < parts_.size(); ++i)
        for (std::size_t k = 0; k < 3 && tips_.is_slit(i) == slit; ++k) {
          const DeformedIndex d = parts_.triangle(i).deformed[k];
          if (std::exchange(seen[parts_.number_of(d)], 1)) continue;
          if (parts_.is_new(parts_.triangle(i).vertex[k]))
            constraints.constraints.push_back(constraint_of(d, i));
          else if (const DeformedIndex one = unknown(parts_.number_of(d)); one != d)
            constraints.constraints.push_back({d, {one, one, one}, {1, 0, 0}});
        }
    add_elements(constraints);
    if (options_.mass == PhantomNode::Mass::lumped) lump(constraints);
    return constraints;
  }

 private:
  /// The number of what i's part has at a corner of its parent. Numbers of vertices come first.
  std::size_t copy(std::size_t i, std::size_t corner) { return parts_.vertices().size() + 3 * parts_.part(i) + corner; }

  void join_copies() {
    copies_.reset(parts_.vertices().size() + 3 * parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto corner = parts_.corner_at(i, parts_.triangle(i).vertex[k]))
          copies_.join(copy(i, *corner), parts_.number_of(parts_.triangle(i).deformed[k]));
    parts_.for_each_joint([&](std::size_t i, std::size_t j, HalfEdge h) {
      if (parts_.have_one_parent(i, j)) return;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto other = parts_.corner_at(j, parts_.parent(i).vertex[k]);
            other && !tips_.are_apart(h, parts_.parent(i).vertex[k]))
          copies_.join(copy(i, k), copy(j, *other));
    });
  }

  void number_phantoms() {
    phantom_.assign(3 * parts_.size(), -1);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t one = copies_.find(copy(i, k));
        if (one < parts_.vertices().size()) continue;
        auto& number = phantom_[one - parts_.vertices().size()];
        if (number >= 0) continue;
        number = to_int32(phantoms_.size());
        phantoms_.push_back(parts_.parent(i).deformed[k]);
      }
  }

  /// Each part, with what its corners have.
  void add_elements(Constraints& constraints) {
    std::vector<std::size_t> element(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_.part(i) == i) {
        element[i] = constraints.copied.size();
        const std::array<DeformedIndex, 3> unknowns{unknown(copy(i, 0)), unknown(copy(i, 1)), unknown(copy(i, 2))};
        const TriangleIndex parent = parts_.parent_slot(i);
        constraints.copied.push_back({parent, parts_.before().corners(parent), unknowns, 0, {}});
      }
      CopiedElement& whole = constraints.copied[element[parts_.part(i)]];
      whole.triangles.push_back(parts_.slot(i));
      whole.share += twice_area(parts_.cut().corners(parts_.slot(i))) / twice_area(whole.corner);
    }
  }

  /// A third of the mass of each part to each copy of its parent's corners, where it is slit to those that its vertices
  /// depend on; of all other triangles to their corners.
  void lump(Constraints& constraints) {
    std::vector<double> area(parts_.vertices().size() + phantoms_.size());
    const auto add = [&](DeformedIndex u, double share) { area[place_of(u)] += share; };
    std::vector<const Constraint*> constraint_of_vertex(parts_.vertices().size());
    for (const Constraint& constraint : constraints.constraints)
      constraint_of_vertex[parts_.number_of(constraint.vertex)] = &constraint;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double share = twice_area(cut_.corners(parts_.slot(i))) / 6;
      for (std::size_t k = 0; k < 3; ++k) {
        const DeformedIndex d = parts_.triangle(i).deformed[k];
        if (!tips_.is_slit(i))
          add(unknown(copy(i, k)), share);
        else if (const Constraint* const constraint = constraint_of_vertex[parts_.number_of(d)]; constraint == nullptr)
          add(d, share);
        else
          for (std::size_t l = 0; l < 3; ++l)
            add(constraint->masters[l], share * std::max(0.0, constraint->weights[l]));
      }
    }
    for (std::size_t number = 0; number < parts_.vertices().size(); ++number)
      for_each_whole_round(parts_.vertices()[number], [&](TriangleIndex t) {
        add(unknown(number), twice_area(cut_.corners(t)) / 6);
      });
    for (std::size_t number = 0; number < parts_.vertices().size(); ++number)
      if (const DeformedIndex d = parts_.vertices()[number];
          !parts_.is_new(cut_.rest_vertex(d)) && unknown(number) == d)
        constraints.lumped.push_back({d, area[number]});
    for (std::size_t i = 0; i < phantoms_.size(); ++i)
      constraints.lumped.push_back({DeformedIndex(cut_.deformed_slots() + i), area[parts_.vertices().size() + i]});
  }

  /// The triangles away from all divided ones that have this corner.
  template <class Visit>
  void for_each_whole_round(DeformedIndex d, const Visit& visit) const {
    if (parts_.is_new(cut_.rest_vertex(d))) return;
    const HalfEdge first = cut_.first_outgoing(cut_.rest_vertex(d));
    HalfEdge h = first;
    do {
      const TriangleIndex t = triangle_of(h);
      if (cut_.triangle(t).deformed[to_size(corner_of(h))] == d && parts_.place_of(t) == parts_.size()) visit(t);
    } while ((h = cut_.next_outgoing(h)).valid() && h != first);
  }

  static double twice_area(const std::array<Point2, 3>& c) { return std::max(0.0, cross(c[1] - c[0], c[2] - c[0])); }

  /// Of an unknown: its vertex's number, or behind these.
  std::size_t place_of(DeformedIndex u) const {
    return u() < cut_.deformed_slots() ? parts_.number_of(u)
                                       : parts_.vertices().size() + (u() - cut_.deformed_slots());
  }

  /// Across every edge of the sheet at which two parts are joined, one of them of a divided parent.
  void add_ghosts(double factor, std::vector<GhostEdge>& ghosts) {
    std::vector<std::pair<TriangleIndex, std::size_t>> parts;  // with their parents
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (parts_.part(i) == i) parts.emplace_back(parts_.parent_slot(i), i);
    std::sort(parts.begin(), parts.end());
    const auto is_divided = [&](std::size_t i) {
      const auto first = std::lower_bound(parts.begin(), parts.end(), std::pair(parts_.parent_slot(i), std::size_t{0}));
      return first + 1 != parts.end() && first[1].first == parts_.parent_slot(i);
    };
    std::set<std::pair<std::size_t, std::size_t>> done;
    parts_.for_each_joint([&](std::size_t i, std::size_t j, HalfEdge) {
      if (parts_.have_one_parent(i, j) || !(is_divided(i) || is_divided(j))) return;
      if (!done.insert(std::minmax(parts_.part(i), parts_.part(j))).second) return;
      const auto& corners = parts_.parent(i).vertex;
      for (std::size_t k = 0; k < 3; ++k)  // the corner of i's parent opposite the edge that both have
        if (!parts_.corner_at(j, corners[k]) && parts_.corner_at(j, corners[(k + 1) % 3]) &&
            parts_.corner_at(j, corners[(k + 2) % 3]))
          ghosts.push_back(ghost_across(i, j, k, factor));
    });
  }

  GhostEdge ghost_across(std::size_t i, std::size_t j, std::size_t k, double factor) {
    const auto c = parts_.before().corners(parts_.parent_slot(i)), d = parts_.before().corners(parts_.parent_slot(j));
    const Point2 a = c[(k + 1) % 3], edge = c[(k + 2) % 3] - a;
    const double length = std::sqrt(squared_length(edge));
    // A field that is 1 at the corner k alone has the slope 1 / height there, along the normal into the triangle; at
    // the ends of the edge it is what makes the field of all three constant.
    std::size_t far = 0;
    while (parts_.corner_at(i, parts_.parent(j).vertex[far])) ++far;
    const double slope_c = length / cross(edge, c[k] - a), slope_d = length / cross(edge, d[far] - a);  // signed
    const double foot_c = dot(c[k] - a, edge) / (length * length), foot_d = dot(d[far] - a, edge) / (length * length);
    // A slit part has a field for each lip here: its own copy of the corner k, and its neighbour's of the edge's ends.
    const auto end = [&](std::size_t corner) {
      return unknown(tips_.is_slit(i) ? copy(j, *parts_.corner_at(j, parts_.parent(i).vertex[corner]))
                                      : copy(i, corner));
    };
    GhostEdge ghost;
    ghost.unknown = {unknown(copy(i, k)), end((k + 1) % 3), end((k + 2) % 3), unknown(copy(j, far))};
    ghost.jump = {slope_c, (foot_c - 1) * slope_c - (foot_d - 1) * slope_d, foot_d * slope_d - foot_c * slope_c,
                  -slope_d};
    ghost.stiffness = factor * length * length;
    ghost.mass = ghost.stiffness * length * length;
    return ghost;
  }

  DeformedIndex unknown(std::size_t number) {
    const std::size_t one = copies_.find(number), vertices = parts_.vertices().size();
    if (one < vertices) return parts_.vertices()[one];
    return DeformedIndex(cut_.deformed_slots() + to_size(phantom_[one - vertices]));
  }

  Constraint constraint_of(DeformedIndex d, std::size_t i) {
    const Point2 p = cut_.rest(cut_.rest_vertex(d));
    const auto c = parts_.before().corners(parts_.parent_slot(i));
    const double twice = cross(c[1] - c[0], c[2] - c[0]);
    Constraint constraint{d, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      constraint.masters[k] = unknown(copy(i, k));
      const Point2 from = c[(k + 1) % 3], to = c[(k + 2) % 3];
      const double area = cross(from - p, to - p);
      // A path that is no farther from an edge goes along it, so this is the rounding of a crossing.
      const bool on_edge =
          std::abs(area) <= rounding_tolerance * parts_.before().snap() * std::sqrt(squared_length(to - from));
      constraint.weights[k] = on_edge ? 0 : area / twice;
    }
    *std::max_element(constraint.weights.begin(), constraint.weights.end()) +=
        1 - (constraint.weights[0] + constraint.weights[1] + constraint.weights[2]);
    return constraint;
  }

  const PhantomNode::Options options_;
  const Parts parts_;
  const OpenTips tips_;
  const Sheet& cut_;
  UnionFind copies_;                     // of vertices, and three for the corners of the parent of each part
  std::vector<std::int32_t> phantom_;    // per copy that is no vertex: its number
  std::vector<DeformedIndex> phantoms_;  // what each is a copy of
};

}  // namespace

void PhantomNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Constraints PhantomNode::constraints(const Sheet& before, const Sheet& cut) const {
  return Doubling(before, cut, options_).run();
}

}  // namespace cutbench
