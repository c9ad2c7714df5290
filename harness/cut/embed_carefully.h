// The fallback where a method cannot embed a path: the path comes so close to older cuts or to its own earlier pieces
// that a rounded crossing falls out of its triangle.
#pragma once

#include "harness/mesh/sheet.h"
#include "harness/path/cut_failed.h"
#include "harness/path/subdivision.h"

namespace cutbench {

/// Makes every piece of the trace a chain of edges marked `path`, without regard to shapes. Points and edges are
/// treated one after the other, and each decision is exact on the mesh as it then is: a node becomes a vertex of the
/// triangle that holds its stored point; a piece is recovered by flips (Sloan, Computers & Structures 47, 1993); where
/// it crosses a border, an incision or an earlier piece, the crossing becomes a vertex there. Where two incisions are
/// closer than doubles can distinguish, in the tip of a thin wedge, the crossing is moved along one of them to the
/// nearest vertex. Returns the largest such move (rest units). \pre the sheet is as it was traced. Throws TooClose
/// where a move would exceed `careful_move_tolerance` (harness/mesh/tolerances.h).
double embed_carefully(Sheet& sheet, const Subdivision& trace);

}  // namespace cutbench
