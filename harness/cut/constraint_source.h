// SPDX-License-Identifier: MIT
// The constraints that a method may give, beside the triangles that it makes: for methods that keep badly shaped
// triangles and take the unknowns from them.
#pragma once

#include <cstdint>

#include "harness/cut/cutting_method.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// What the constraints are. It is asked before a cut, since not every solver supports every kind.
enum class ConstraintKind : std::uint8_t {
  vertices,         ///< constraints of vertices of the sheet to triangles of the sheet
  polygons,         ///< triangles that are one element together
  phantoms,         ///< constraints to triangles with phantom nodes, which are not vertices of the sheet
  lumped_phantoms,  ///< the same with a mass of the unknowns, for explicit steps, too
  phantoms_at_rest  ///< the same, with a penalty that holds for a sheet at rest only
};

/// A method that gives constraints derives from this, too, and returns itself as CuttingMethod::constraint_source().
class ConstraintSource {
 public:
  virtual ConstraintKind constraint_kind() const = 0;
  /// The constraints between the vertices of a sheet that the method cut any number of times, and the polygons that it
  /// makes of triangles. Depends on the two sheets alone.
  /// \param before  the sheet before the first cut; no slot of it has moved since (Sheet::compact() would move them)
  virtual Constraints constraints(const Sheet& before, const Sheet& cut) const = 0;
  /// The same after one more cut, that of the log of `cut`. Returns all constraints, but only the new polygons: an old
  /// polygon stays unless it shares a triangle with a new one. The default returns the polygons of all cuts.
  /// \param last  what constraints() or this returned before that cut; empty before the first one
  virtual Constraints next_constraints(const Sheet& before, const Sheet& cut, const Constraints& /*last*/,
                                       const PolygonsLeft& /*left*/) const {
    return constraints(before, cut);
  }

 protected:
  ~ConstraintSource() = default;  // it is deleted as the method that it is
};

/// What the method's source gives; none without one: every vertex has its own unknowns.
inline Constraints constraints_of(const CuttingMethod& method, const Sheet& before, const Sheet& cut) {
  const ConstraintSource* const source = method.constraint_source();
  return source ? source->constraints(before, cut) : Constraints{};
}

}  // namespace cutbench
