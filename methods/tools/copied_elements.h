// What phantom_node and virtual_node share: triangles of the sheet before its first cut as elements, copied where cuts
// divide them, each copy with the material of one part.
//
// A part has its own copy of its parent's three corners as its unknowns: a corner that belongs to the part is that
// vertex of the sheet, any other is a phantom node. Parts on the two sides of an edge of the sheet that are joined
// along it, or along a piece of it, share the copies of its two ends. All vertices that cuts made are constrained to
// the corners of their part by their barycentric coordinates. So sums over the triangles of a part are exact integrals
// over it, for any number of cuts, junctions and loops, and where a cut goes through a vertex, too: what counts is what
// is joined along edges.
#pragma once

#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

struct CopyOptions {
  bool lumped_mass = true;
  bool open_tips = true;  ///< the rule of open_tips.h; else a part with a tip in it is an element like all others
  double ghost = 0;       ///< dimensionless; 0: no penalty
};

/// Of all cuts. `copied` is by rising parents, `lumped` by rising unknowns.
Constraints copied_elements(const Sheet& before, const Sheet& cut, const CopyOptions& options);

/// The same but for the order of phantom nodes, from what the log of `cut` names (last_cut.h).
/// \param last  what either of these returned before the last cut, with these options; empty before the first one
Constraints next_copied_elements(const Sheet& before, const Sheet& cut, const CopyOptions& options,
                                 const Constraints& last);

}  // namespace cutbench
