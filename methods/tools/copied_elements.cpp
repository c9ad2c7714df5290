#include "methods/tools/copied_elements.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/tolerances.h"
#include "methods/tools/last_cut.h"
#include "methods/tools/open_tips.h"
#include "methods/tools/parts.h"

namespace cutbench {

namespace {

OpenTips::Rule tip_rule(const CopyOptions& options) {
  if (!options.open_tips) return OpenTips::Rule::closed;
  return options.lumped_mass ? OpenTips::Rule::open_for_lumped_mass : OpenTips::Rule::open;
}

/// Sorts those from `first` on into the others, which are in order.
template <class T, class Less>
void merge_in(std::vector<T>& all, std::size_t first, const Less& less) {
  const auto middle = all.begin() + to_index(first);
  std::sort(middle, all.end(), less);
  std::inplace_merge(all.begin(), middle, all.end(), less);
}

bool by_unknown(const LumpedArea& a, const LumpedArea& b) { return a.unknown < b.unknown; }

class Doubling {
 public:
  Doubling(const Sheet& before, const Sheet& cut, const CopyOptions& options)
      : options_(options), parts_(before, cut), tips_(parts_, tip_rule(options)), cut_(cut) {
    join_copies();
  }

  /// After one more cut than `last`, of which all else stays.
  Doubling(const Sheet& before, const Sheet& cut, const CopyOptions& options, const LastCut& last_cut,
           const Constraints& last)
      : options_(options),
        parts_(before, cut, last_cut.near()),
        tips_(parts_, tip_rule(options)),
        cut_(cut),
        last_cut_(&last_cut),
        last_(&last) {
    join_copies();
    keep_phantoms();
    keep_unknowns();
  }

  Constraints run() {
    number_phantoms();
    Constraints constraints;
    constraints.phantoms = phantoms_;
    if (options_.ghost > 0) add_ghosts(options_.ghost, constraints.ghosts);
    if (last_) keep_constraints(constraints);
    std::vector<std::uint8_t> seen(parts_.vertices().size());
    for (std::size_t number = 0; last_ && number < seen.size(); ++number) seen[number] = !is_looked_at_again(number);
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
    if (options_.lumped_mass) lump(constraints);
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

  // --- what is left of before the last cut ---------------------------------------------------------------------------

  bool stays(VertexIndex v) const { return last_ && !last_cut_->touches(v); }
  /// Where an unknown of before is now. \pre its corner stays
  DeformedIndex now(DeformedIndex u) const {
    const std::size_t first = cut_.log().deformed_before;
    return u() < first ? u : DeformedIndex(cut_.deformed_slots() + to_size(kept_[u() - first]));
  }

  /// Each that stays keeps its number, so that what is derived from the numbers stays, too.
  void keep_phantoms() {
    const std::size_t first = cut_.log().deformed_before;
    phantoms_.assign(last_->phantoms.size(), DeformedIndex());
    kept_.assign(last_->phantoms.size(), -1);
    for (const CopiedElement& element : last_->copied)
      for (std::size_t k = 0; k < 3; ++k)
        if (element.unknown[k]() >= first && stays(parts_.before().triangle(element.parent).vertex[k])) {
          const std::size_t i = element.unknown[k]() - first;
          kept_[i] = to_int32(i);
          phantoms_[i] = last_->phantoms[i];
        }
  }

  /// Gives the copies of corners that stay the unknowns that they had.
  void keep_unknowns() {
    fixed_.resize(parts_.vertices().size() + 3 * parts_.size());
    std::vector<DeformedIndex> stands_for = parts_.vertices();
    for (const Constraint& constraint : last_->constraints)
      if (const std::size_t number = parts_.number_of(constraint.vertex); parts_.has(number, constraint.vertex))
        stands_for[number] = constraint.masters[0];
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_.part(i) != i) continue;
      const auto all = elements_of(last_->copied, parts_.parent_slot(i));
      const auto was = std::find_if(all.begin(), all.end(), [&](const CopiedElement& element) {
        return element.triangles.front() == parts_.slot(i);
      });
      for (std::size_t k = 0; k < 3; ++k)
        if (const VertexIndex v = parts_.parent(i).vertex[k]; stays(v))
          fixed_[copies_.find(copy(i, k))] =
              was != all.end() ? was->unknown[k] : stands_for[parts_.number_of(corner_of_whole(i, v))];
    }
  }

  /// Of a triangle that was not divided.
  DeformedIndex corner_of_whole(std::size_t i, VertexIndex v) const {
    const auto& corners = parts_.triangle(i).vertex;
    return parts_.triangle(i).deformed[to_size(std::find(corners.begin(), corners.end(), v) - corners.begin())];
  }

  /// What it is constrained to may be another: all triangles round a vertex that cuts made are among the parts.
  bool is_looked_at_again(std::size_t number) const {
    const DeformedIndex d = parts_.vertices()[number];
    const VertexIndex v = cut_.rest_vertex(d);
    if (!parts_.is_new(v)) return last_cut_->touches(v);
    bool all = true;
    for_each_round(d, [&](TriangleIndex t) { all &= parts_.place_of(t) < parts_.size(); });
    return all;
  }

  void keep_constraints(Constraints& constraints) const {
    constraints.constraints.reserve(last_->constraints.size() + parts_.vertices().size());
    constraints.copied.reserve(last_->copied.size() + parts_.size());
    constraints.lumped.reserve(last_->lumped.size() + parts_.vertices().size());
    for (Constraint constraint : last_->constraints) {
      const std::size_t number = parts_.number_of(constraint.vertex);
      if (parts_.has(number, constraint.vertex) && is_looked_at_again(number)) continue;
      const auto largest = std::max_element(constraint.weights.begin(), constraint.weights.end());
      const DeformedIndex first = constraint.masters[to_size(largest - constraint.weights.begin())];
      for (std::size_t k = 0; k < 3; ++k)  // what is left out may be no more
        constraint.masters[k] = now(constraint.weights[k] == 0 ? first : constraint.masters[k]);
      constraints.constraints.push_back(constraint);
    }
    for (const CopiedElement& element : last_->copied) {
      if (last_cut_->reaches(element.parent)) continue;
      constraints.copied.push_back(element);
      for (DeformedIndex& u : constraints.copied.back().unknown) u = now(u);
    }
    const std::size_t first = cut_.log().deformed_before;
    for (const auto& [u, area] : last_->lumped)
      if (u() < first ? stays(cut_.rest_vertex(u)) : kept_[u() - first] >= 0)
        constraints.lumped.push_back({now(u), area});
    merge_in(constraints.lumped, 0, by_unknown);  // a phantom may have another number
  }

  bool was_lumped(DeformedIndex d) const {
    return std::binary_search(last_->lumped.begin(), last_->lumped.end(), LumpedArea{d, 0}, by_unknown);
  }

  // --- all of it -----------------------------------------------------------------------------------------------------

  /// New ones take the numbers that have become free; where more have, those with the last numbers do.
  void number_phantoms() {
    std::size_t free = 0;
    const auto next_free = [&] {
      while (free < phantoms_.size() && phantoms_[free].valid()) ++free;
      return free;
    };
    phantom_.assign(3 * parts_.size(), -1);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t one = copies_.find(copy(i, k));
        if (one < parts_.vertices().size() || is_fixed(one)) continue;
        auto& number = phantom_[one - parts_.vertices().size()];
        if (number >= 0) continue;
        number = to_int32(next_free());
        new_phantoms_.push_back(number);
        if (free == phantoms_.size()) phantoms_.emplace_back();
        phantoms_[free] = parts_.parent(i).deformed[k];
      }
    for (; next_free() < phantoms_.size(); phantoms_.pop_back()) {
      if (!phantoms_.back().valid()) continue;
      phantoms_[free] = phantoms_.back();
      kept_[phantoms_.size() - 1] = to_int32(free);  // no new one is behind a free number
    }
  }

  /// Each part, with what its corners have.
  void add_elements(Constraints& constraints) {
    const std::size_t kept = constraints.copied.size();
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
    merge_in(constraints.copied, kept, [](const CopiedElement& a, const CopiedElement& b) {
      return std::tuple(a.parent, a.triangles.front()) < std::tuple(b.parent, b.triangles.front());
    });
  }

  /// A third of the mass of each part to each copy of its parent's corners, where it is slit to those that its vertices
  /// depend on; of all other triangles to their corners. Of phantom nodes of before it is known.
  void lump(Constraints& constraints) {
    const std::size_t kept_areas = constraints.lumped.size();
    std::unordered_map<std::int32_t, double> area;
    const auto add = [&](DeformedIndex u, double share) { area[u.value] += share; };
    std::vector<const Constraint*> constraint_of_vertex(parts_.vertices().size());
    for (const Constraint& constraint : constraints.constraints)
      if (const std::size_t number = parts_.number_of(constraint.vertex); parts_.has(number, constraint.vertex))
        constraint_of_vertex[number] = &constraint;
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
      if (const DeformedIndex d = parts_.vertices()[number]; !parts_.is_new(cut_.rest_vertex(d)))
        for_each_round(d, [&](TriangleIndex t) {
          if (parts_.place_of(t) == parts_.size()) add(unknown(number), twice_area(cut_.corners(t)) / 6);
        });
    for (std::size_t number = 0; number < parts_.vertices().size(); ++number) {
      const DeformedIndex d = parts_.vertices()[number];
      const VertexIndex v = cut_.rest_vertex(d);
      if (!parts_.is_new(v) && unknown(number) == d && !(stays(v) && was_lumped(d)))
        constraints.lumped.push_back({d, area[d.value]});
    }
    for (const std::int32_t i : new_phantoms_) {
      const DeformedIndex u(cut_.deformed_slots() + to_size(i));
      constraints.lumped.push_back({u, area[u.value]});
    }
    merge_in(constraints.lumped, kept_areas, by_unknown);
  }

  /// The triangles that have this corner.
  template <class Visit>
  void for_each_round(DeformedIndex d, const Visit& visit) const {
    const HalfEdge first = cut_.first_outgoing(cut_.rest_vertex(d));
    HalfEdge h = first;
    do
      if (cut_.triangle(triangle_of(h)).deformed[to_size(corner_of(h))] == d) visit(triangle_of(h));
    while ((h = cut_.next_outgoing(h)).valid() && h != first);
  }

  static double twice_area(const std::array<Point2, 3>& c) { return std::max(0.0, cross(c[1] - c[0], c[2] - c[0])); }

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

  /// It is an unknown that stays.
  bool is_fixed(std::size_t one) const { return last_ && fixed_[one].valid(); }
  DeformedIndex unknown(std::size_t number) {
    const std::size_t one = copies_.find(number), vertices = parts_.vertices().size();
    if (is_fixed(one)) return now(fixed_[one]);
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

  const CopyOptions options_;
  const Parts parts_;
  const OpenTips tips_;
  const Sheet& cut_;
  UnionFind copies_;                        // of vertices, and three for the corners of the parent of each part
  std::vector<std::int32_t> phantom_;       // per copy that is no vertex: its number
  std::vector<std::int32_t> new_phantoms_;  // their numbers
  std::vector<DeformedIndex> phantoms_;     // what each is a copy of
  // Of the last cut; null where all cuts are looked at.
  const LastCut* last_cut_ = nullptr;
  const Constraints* last_ = nullptr;
  std::vector<std::int32_t> kept_;    // per phantom of before: its number now, -1: none
  std::vector<DeformedIndex> fixed_;  // per class of copies: the unknown that it was, where that stays
};

}  // namespace

Constraints copied_elements(const Sheet& before, const Sheet& cut, const CopyOptions& options) {
  return Doubling(before, cut, options).run();
}

Constraints next_copied_elements(const Sheet& before, const Sheet& cut, const CopyOptions& options,
                                 const Constraints& last) {
  if (options.ghost > 0) return copied_elements(before, cut, options);  // for sheets at rest
  const LastCut last_cut(before, cut, last);
  return Doubling(before, cut, options, last_cut, last).run();
}

}  // namespace cutbench
