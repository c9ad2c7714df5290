#include "harness/fem/elements/copied_bending.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Rings of whole triangles round the elements: those whose stencils reach into divided ones, and those that their
/// slopes are fitted to.
constexpr int replaced_rings = 1, all_rings = 4;

/// The copies and what is near them, as arrays.
class SheetOfCopies {
 public:
  SheetOfCopies(const Sheet& cut, const Constraints& constraints) : cut_(cut), constraints_(constraints) {
    for (const Constraint& constraint : constraints.constraints)
      if (constraint.weights[0] == 1) stands_for_[constraint.vertex.value] = constraint.masters[0];
    for (const CopiedElement& element : constraints.copied) {
      add(element.unknown, element.corner);
      for (const TriangleIndex t : element.triangles) seen_.insert(t.value);
    }
    add_rings();
    data_.deformed.resize(data_.rest.size());
  }

  ReplacedStencils stencils(const Bending& like) {
    const Bending bending(Sheet(data_), like.kind(), like.rigidity(), like.poisson());
    ReplacedStencils replaced;
    for (std::size_t i = 0; i < constraints_.copied.size(); ++i) {
      const CopiedElement& element = constraints_.copied[i];
      put(element.triangles.front(), bending.stencil(i), std::sqrt(element.share), replaced);
      for (std::size_t k = 1; k < element.triangles.size(); ++k) put(element.triangles[k], {}, 0, replaced);
    }
    for (std::size_t i = 0; i < replaced_whole_; ++i)
      put(whole_[i], bending.stencil(constraints_.copied.size() + i), 1, replaced);
    return replaced;
  }

 private:
  void add(const std::array<DeformedIndex, 3>& unknown, const std::array<Point2, 3>& corner) {
    std::array<std::int32_t, 3> local;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = number_.emplace(unknown[k].value, to_int32(data_.rest.size()));
      if (is_new) add_vertex(unknown[k], corner[k]);
      local[k] = at->second;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = [&] { return std::int64_t{local[k]} << 32 | local[(k + 1) % 3]; };
      if (edges_.insert(edge()).second) continue;
      local[k] = to_int32(data_.rest.size());
      add_vertex(unknown[k], corner[k]);
      edges_.insert(edge());
    }
    data_.triangles.push_back(local);
  }
  void add_vertex(DeformedIndex unknown, Point2 rest) {
    data_.rest.push_back(rest);
    unknown_.push_back(unknown);
  }

  void add_rings() {
    std::vector<TriangleIndex> front;
    for (const CopiedElement& element : constraints_.copied)
      front.insert(front.end(), element.triangles.begin(), element.triangles.end());
    for (int ring = 0; ring < all_rings; ++ring) {
      const std::size_t first = whole_.size();
      for (const TriangleIndex t : front)
        for (int k = 0; k < 3; ++k)
          if (const HalfEdge h = half_edge(t, k); !cut_.separates(h))
            if (const TriangleIndex u = triangle_of(cut_.opposite(h)); seen_.insert(u.value).second)
              whole_.push_back(u);
      front.assign(whole_.begin() + to_index(first), whole_.end());
      if (ring + 1 == replaced_rings) replaced_whole_ = whole_.size();
    }
    for (const TriangleIndex t : whole_) {
      std::array<DeformedIndex, 3> unknown = cut_.triangle(t).deformed;
      for (DeformedIndex& d : unknown)
        if (const auto other = stands_for_.find(d.value); other != stands_for_.end()) d = other->second;
      add(unknown, cut_.corners(t));
    }
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

  const Sheet& cut_;
  const Constraints& constraints_;
  MeshData data_;
  std::vector<DeformedIndex> unknown_;                          // per vertex of data_
  std::unordered_map<std::int32_t, std::int32_t> number_;       // of unknowns: in data_
  std::unordered_map<std::int32_t, DeformedIndex> stands_for_;  // the unknown that a vertex is the same as
  std::unordered_set<std::int64_t> edges_;                      // directed, of data_
  std::unordered_set<std::int32_t> seen_;                       // slots
  std::vector<TriangleIndex> whole_;                            // round the elements, ring by ring
  std::size_t replaced_whole_ = 0;
  std::vector<StencilTerm> terms_;
};

}  // namespace

ReplacedStencils copied_stencils(const Sheet& cut, const Constraints& constraints, const Bending& like) {
  return SheetOfCopies(cut, constraints).stencils(like);
}

}  // namespace cutbench
