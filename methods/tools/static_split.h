// The conventional split, used by conventional_split and by methods that keep its triangles.
//
// A triangle crossed by the path through two edges becomes three, one in which the path goes from a corner to the
// opposite edge becomes two, and one in which it ends becomes four. The order of connection is static and does not
// depend on the shapes: the quadrilateral that a crossing leaves is divided from the point where the path comes in to
// the far corner, and a tip is joined to all points round it. Triangles that hold other points (corners of the path,
// curve points, crossings of the path with itself), or that the path passes more than once, are divided step by step
// (split_step_by_step()).
#pragma once

#include "harness/cut/delaunay_split.h"

namespace cutbench {

/// Embeds the trace. Returns the number of segments that had to be recovered. Throws CutFailed.
int embed_by_static_split(Sheet& sheet, Subdivision& trace, PatchWork& work);

/// Fills patch.triangles; returns the number of segments that had to be recovered.
int split_conventionally(Patch& patch);

}  // namespace cutbench
