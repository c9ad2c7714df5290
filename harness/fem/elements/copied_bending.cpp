#include "harness/fem/elements/copied_bending.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Over the patch of a neighbour, and one ring more: which of three elements at an edge has one of its own depends on
/// the one that is two rings away.
int reach_over(int patch) { return patch + 2; }
constexpr int usual_patch = 2;  ///< of well-shaped triangles

template <class T>
bool comes_before(const T& a, const T& b) {
  return std::tie(a.parent, a.first) < std::tie(b.parent, b.first);
}

/// Copies and whole triangles near them as a sheet, in arrays.
class SheetOfCopies {
 public:
  SheetOfCopies(const Sheet& cut, const Constraints& constraints) : cut_(cut) {
    for (const Constraint& constraint : constraints.constraints)
      if (constraint.weights[0] == 1) stands_for_[constraint.vertex.value] = constraint.masters[0];
  }

  void add(const CopiedElement& copy) { add(copy.unknown, copy.corner); }
  void add(TriangleIndex whole) {
    std::array<DeformedIndex, 3> unknown = cut_.triangle(whole).deformed;
    for (DeformedIndex& d : unknown)
      if (const auto other = stands_for_.find(d.value); other != stands_for_.end()) d = other->second;
    add(unknown, cut_.corners(whole));
  }
  Sheet sheet() {
    data_.deformed.resize(data_.rest.size());
    return Sheet(data_);
  }

  void put(TriangleIndex slot, std::span<const StencilTerm> terms, double factor, ReplacedStencils& replaced) {
    terms_.clear();
    for (const StencilTerm& term : terms) {
      const std::int32_t unknown = unknown_[to_size(term.vertex)].value;
      auto at = std::find_if(terms_.begin(), terms_.end(), [&](const StencilTerm& t) { return t.vertex == unknown; });
      if (at == terms_.end()) at = terms_.insert(at, {unknown, {}});
      for (std::size_t k = 0; k < 3; ++k) at->factor[k] += factor * term.factor[k];
    }
    replaced.slots.push_back(slot);
    replaced.rows.resize(replaced.slots.size());
    replaced.rows.set(replaced.slots.size() - 1, terms_);
  }

 private:
  void add(const std::array<DeformedIndex, 3>& unknown, const std::array<Point2, 3>& corner) {
    std::array<std::int32_t, 3> local;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = number_.emplace(unknown[k].value, to_int32(data_.rest.size()));
      if (is_new) add_vertex(unknown[k], corner[k]);
      local[k] = at->second;
    }
    const std::array<std::int32_t, 3> shared = local;
    for (std::size_t k = 0; k < 3; ++k) {
      if (edges_.insert(std::int64_t{shared[k]} << 32 | shared[(k + 1) % 3]).second) continue;
      local[k] = to_int32(data_.rest.size());
      add_vertex(unknown[k], corner[k]);
    }
    data_.triangles.push_back(local);
  }
  void add_vertex(DeformedIndex unknown, Point2 rest) {
    data_.rest.push_back(rest);
    unknown_.push_back(unknown);
  }

  const Sheet& cut_;
  MeshData data_;
  std::vector<DeformedIndex> unknown_;                          // per vertex of data_
  std::unordered_map<std::int32_t, std::int32_t> number_;       // of unknowns: in data_
  std::unordered_map<std::int32_t, DeformedIndex> stands_for_;  // the unknown that a vertex is the same as
  std::unordered_set<std::int64_t> edges_;                      // directed, between numbers of number_
  std::vector<StencilTerm> terms_;
};

/// Calls act(other) for the triangles that t is joined to.
template <class Act>
void for_each_joint(const Sheet& cut, TriangleIndex t, const Act& act) {
  for (int k = 0; k < 3; ++k)
    if (const HalfEdge h = half_edge(t, k); !cut.separates(h)) act(triangle_of(cut.opposite(h)));
}

}  // namespace

ReplacedStencils CopiedBending::all(const Sheet& cut, const Constraints& constraints, const Bending& like) {
  clear();
  return next(cut, constraints, like, {});
}

ReplacedStencils CopiedBending::next(const Sheet& cut, const Constraints& constraints, const Bending& like,
                                     std::span<const TriangleIndex> rebuilt) {
  parent_of_.resize(cut.triangle_slots(), -1);
  reach_ = std::max(reach_, reach_over(like.has_slopes() ? usual_patch : 0));
  std::vector<TriangleIndex> changed;
  if (!empty()) {
    for (const auto& touched : cut.log().touched) changed.push_back(touched.slot);
    for (std::size_t t = cut.log().triangles_before; t < cut.triangle_slots(); ++t) changed.emplace_back(t);
    std::erase_if(changed, [&](TriangleIndex t) { return !cut.triangle(t).alive(); });
  }
  learn(constraints, changed);
  for (;;) {
    const int before = reach_;
    ReplacedStencils replaced = stencils_of(cut, constraints, like, changed, rebuilt);
    if (reach_ == before) return replaced;
  }
}

/// Adds the triangles of copies that are not as they were.
void CopiedBending::learn(const Constraints& constraints, std::vector<TriangleIndex>& changed) {
  std::vector<Known> now;
  now.reserve(constraints.copied.size());
  for (const CopiedElement& copy : constraints.copied) {
    std::uint64_t hash = 0;
    for (const TriangleIndex t : copy.triangles) hash = (hash ^ std::uint64_t(t())) * 0x9e3779b97f4a7c15U;
    now.push_back({copy.parent, copy.triangles.front(), copy.unknown, copy.share, hash});
    const auto was = std::lower_bound(known_.begin(), known_.end(), now.back(), comes_before<Known>);
    if (was != known_.end() && *was == now.back()) continue;
    for (const TriangleIndex t : copy.triangles) {
      parent_of_[t()] = copy.parent.value;
      changed.push_back(t);
    }
  }
  known_ = std::move(now);
}

/// The copy that a triangle is a part of; null: it is whole.
const CopiedElement* CopiedBending::element_of(const Constraints& constraints, TriangleIndex t) const {
  const std::int32_t parent = parent_of_[t()];
  if (parent < 0) return nullptr;
  const auto& all = constraints.copied;
  auto copy = std::lower_bound(all.begin(), all.end(), parent,
                               [](const CopiedElement& c, std::int32_t p) { return c.parent.value < p; });
  for (; copy != all.end() && copy->parent.value == parent; ++copy)
    if (std::binary_search(copy->triangles.begin(), copy->triangles.end(), t)) return &*copy;
  return nullptr;
}

/// With all triangles of its copy.
void CopiedBending::add_member(const Constraints& constraints, TriangleIndex t, Slots& slots,
                               std::vector<TriangleIndex>& front) const {
  if (slots.contains(t.value)) return;
  const CopiedElement* const copy = element_of(constraints, t);
  for (const TriangleIndex member : copy ? std::span(copy->triangles) : std::span(&t, 1)) {
    slots.insert(member.value);
    front.push_back(member);
  }
}

/// Of elements, round the last ones of `slots`, across incisions, too: copies may have both ends of an edge in common
/// that are not joined there.
void CopiedBending::add_rings(const Sheet& cut, const Constraints& constraints, int rings, Slots& slots,
                              std::vector<TriangleIndex> front) const {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<TriangleIndex> next;
    for (const TriangleIndex t : front)
      for (const HalfEdge other : cut.triangle(t).opposite)
        if (other.valid()) add_member(constraints, triangle_of(other), slots, next);
    front = std::move(next);
  }
}

/// As far as `reach_` says; sets that to more where a patch reaches farther.
ReplacedStencils CopiedBending::stencils_of(const Sheet& cut, const Constraints& constraints, const Bending& like,
                                            const std::vector<TriangleIndex>& changed,
                                            std::span<const TriangleIndex> rebuilt) {
  Slots near;
  std::vector<TriangleIndex> front;
  for (const TriangleIndex t : changed) add_member(constraints, t, near, front);
  add_rings(cut, constraints, reach_, near, std::move(front));
  front.clear();
  for (const TriangleIndex t : rebuilt)
    if (cut.triangle(t).alive()) add_member(constraints, t, near, front);

  Slots replaced;
  front.clear();
  for (const std::int32_t slot : near) {
    const TriangleIndex t(to_size(slot));
    bool beside = element_of(constraints, t) != nullptr;
    for_each_joint(cut, t, [&](TriangleIndex other) { beside |= element_of(constraints, other) != nullptr; });
    if (beside) add_member(constraints, t, replaced, front);
  }
  Slots region = replaced;
  add_rings(cut, constraints, reach_, region, std::move(front));

  // In the order of all copies and all slots, so that what a stencil is does not depend on the region.
  std::vector<const CopiedElement*> copies;
  std::vector<TriangleIndex> whole;
  for (const std::int32_t slot : region) {
    const TriangleIndex t(to_size(slot));
    const CopiedElement* const copy = element_of(constraints, t);
    if (!copy)
      whole.push_back(t);
    else if (copy->triangles.front() == t)
      copies.push_back(copy);
  }
  std::sort(copies.begin(), copies.end());
  std::sort(whole.begin(), whole.end());
  SheetOfCopies arrays(cut, constraints);
  for (const CopiedElement* const copy : copies) arrays.add(*copy);
  for (const TriangleIndex t : whole) arrays.add(t);
  const Sheet sheet = arrays.sheet();
  const Bending bending(sheet, like.kind(), like.rigidity(), like.poisson());

  ReplacedStencils result;
  for (std::size_t i = 0; i < copies.size() + whole.size(); ++i) {
    const bool is_copy = i < copies.size();
    const TriangleIndex slot = is_copy ? copies[i]->triangles.front() : whole[i - copies.size()];
    if (!replaced.contains(slot.value)) continue;
    arrays.put(slot, bending.stencil(i), is_copy ? std::sqrt(copies[i]->share) : 1, result);
    for (std::size_t k = 1; is_copy && k < copies[i]->triangles.size(); ++k)
      arrays.put(copies[i]->triangles[k], {}, 0, result);
    reach_ = std::max(reach_, reach_over(bending.reach(i)));
    for_each_joint(sheet, TriangleIndex(i),
                   [&](TriangleIndex other) { reach_ = std::max(reach_, reach_over(bending.reach(other()))); });
  }
  return result;
}

}  // namespace cutbench
