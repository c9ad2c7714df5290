// The plain embedding, for methods whose own work comes before it or after it: every crossed triangle is divided along
// the path, and nothing else of the mesh changes.
#pragma once

#include "harness/cut/patch.h"

namespace cutbench {

/// Embeds the trace: crossed triangles with the Delaunay diagonal, all others step by step. Returns the number of
/// segments that had to be recovered. Throws CutFailed.
int embed_by_delaunay_split(Sheet& sheet, Subdivision& trace, PatchWork& work);

/// Is the diagonal p - c of a crossing (else q - a) Delaunay? On a tie the point that the path met first has it, as
/// when it is inserted first.
bool is_diagonal_from_p_delaunay(const Crossing& crossing);

/// Fills patch.triangles: points inside first, each splitting the triangle that holds it into three, then those on the
/// edges, each splitting the triangle behind it into two, all in path order; then segments that are missing are brought
/// in by flips. Returns the number of these.
int split_step_by_step(Patch& patch);

}  // namespace cutbench
