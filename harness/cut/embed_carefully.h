// The way out where a method can't embed a path: the path comes so near to older cuts or to its own earlier pieces that
// a rounded crossing falls out of its triangle.
#pragma once

#include "harness/mesh/sheet.h"
#include "harness/path/cut_failed.h"
#include "harness/path/subdivision.h"

namespace cutbench {

/// Makes every piece of the trace a chain of edges marked `path`, whatever the shapes that come of it. One point and
/// one edge after the other, each decision an exact one on the mesh as it then is: a node becomes a vertex of the
/// triangle that holds its stored point, a piece is brought in by flips (Sloan, Computers & Structures 47, 1993), and
/// where it crosses a border, an incision or an earlier piece the crossing becomes a vertex there. Where two incisions
/// are closer than doubles can tell apart, in the tip of a thin wedge, the crossing is moved along one of them to the
/// nearest vertex. Returns how far at most (rest units). \pre the sheet is as it was traced. Throws TooClose where
/// that would be over 1e-4 mean rest edges.
double embed_carefully(Sheet& sheet, const Subdivision& trace);

}  // namespace cutbench
