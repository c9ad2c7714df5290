// Bending where cuts made copies of triangles (CopiedElement, harness/mesh/constraints.h): the field is linear in each
// copy, so the triangles that its material is cut into have no bending of their own.
//
// The copies, with the whole triangles round them, are a sheet by themselves, which may overlap itself: two are
// neighbours where they have both ends of an edge in common. Its stencils, of whatever kind of bending, are those of
// that sheet, with the energy of a copy times its share of the material. Where three would be neighbours across one
// edge, round a tip that stays closed, the third has an edge of its own there.
//
// Replaced are the stencils of the copies, and of the whole triangles beside them. A copy's is in the slot of its first
// triangle, the slots of its others are empty. After a cut only those are made again that are near what it changed.
#pragma once

#include <unordered_set>

#include "harness/fem/elements/bending.h"

namespace cutbench {

class CopiedBending {
 public:
  /// Of all copies. \param like  for the kind and the material
  ReplacedStencils all(const Sheet& cut, const Constraints& constraints, const Bending& like);
  /// What differs from the last call. \pre there was one; all cuts since are in the log of `cut`.
  /// \param rebuilt  slots whose stencils were made those of the sheet since then
  ReplacedStencils next(const Sheet& cut, const Constraints& constraints, const Bending& like,
                        std::span<const TriangleIndex> rebuilt);
  bool empty() const { return known_.empty(); }
  void clear() { known_.clear(); }

 private:
  /// A copy of the last call, without what it can be told from another one without.
  struct Known {
    TriangleIndex parent, first;
    std::array<DeformedIndex, 3> unknown;
    double share;
    std::uint64_t triangles;  ///< a hash of their slots
    bool operator==(const Known&) const = default;
  };
  using Slots = std::unordered_set<std::int32_t>;

  void learn(const Constraints& constraints, std::vector<TriangleIndex>& changed);
  const CopiedElement* element_of(const Constraints& constraints, TriangleIndex t) const;
  void add_member(const Constraints& constraints, TriangleIndex t, Slots& slots,
                  std::vector<TriangleIndex>& front) const;
  void add_rings(const Sheet& cut, const Constraints& constraints, int rings, Slots& slots,
                 std::vector<TriangleIndex> front) const;
  ReplacedStencils stencils_of(const Sheet& cut, const Constraints& constraints, const Bending& like,
                               const std::vector<TriangleIndex>& changed, std::span<const TriangleIndex> rebuilt);

  std::vector<Known> known_;             // by rising parents and first triangles, as Constraints::copied
  std::vector<std::int32_t> parent_of_;  // per slot: the parent of its copy; may name a copy that has it no more
  int reach_ = 0;                        // rings over which a change reaches the stencil of another element
};

}  // namespace cutbench
