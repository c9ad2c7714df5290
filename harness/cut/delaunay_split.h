// The Delaunay split, which is the default embedding: every crossed triangle is divided along the path by itself, and
// nothing else of the mesh changes.
#pragma once

#include "harness/cut/patch.h"

namespace cutbench {

/// Embeds the trace: a triangle with one crossing gets the Delaunay diagonal, every other one is divided step by step
/// (split_step_by_step()). Returns the number of segments that had to be recovered. Throws CutFailed.
int embed_by_delaunay_split(Sheet& sheet, Subdivision& trace, PatchWork& work);

/// Whether p - c is the Delaunay diagonal of the crossing's quadrilateral p, q, c, a (otherwise q - a is). Where all
/// four points lie on one circle, the diagonal starts at the point that the path met first, as if that were inserted
/// first.
bool is_diagonal_from_p_delaunay(const Crossing& crossing);

/// Fills patch.triangles. Points inside come first, each splits the triangle that holds it into three; then those on
/// the edges, each splits the triangle at its edge into two; both in path order. Missing segments are then recovered by
/// flips. Returns the number of these.
int split_step_by_step(Patch& patch);

}  // namespace cutbench
