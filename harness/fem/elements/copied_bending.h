// Bending where cuts made copies of triangles (CopiedElement, harness/mesh/constraints.h): the field is linear in each
// copy, so the triangles that its material is cut into have no bending of their own.
//
// The copies, with the whole triangles round them, are a sheet by themselves, which may overlap itself: two are
// neighbours where they have both ends of an edge in common. Its stencils, of whatever kind of bending, are those of
// that sheet, with the energy of a copy times its share of the material. Where three would be neighbours across one
// edge, round a tip that stays closed, the third has an edge of its own there.
#pragma once

#include "harness/fem/elements/bending.h"

namespace cutbench {

/// Of the copied elements, and of the whole triangles whose stencils would hold a vertex within one. A copy's is in the
/// slot of its first triangle, the slots of its others are empty.
/// \param like  for the kind and the material
ReplacedStencils copied_stencils(const Sheet& cut, const Constraints& constraints, const Bending& like);

}  // namespace cutbench
