// Conventional subdivision: the plain split that every other method is compared with.
//
// How it works: a triangle crossed by the path through two edges becomes three, one in which the path goes from a
// corner to the opposite edge becomes two, and one in which it ends becomes four. The order of connection is static and
// looks at no shape: the quadrilateral that a crossing leaves is divided from the point where the path comes in to the
// far corner, a tip is joined to everything round it. In a triangle that holds kept points (corners of the path, curve
// points, crossings with itself) or that the path passes more than once, points inside are inserted first, each
// splitting the triangle that holds it into three, then those on the edges, each splitting the triangle behind it into
// two, all in path order; path segments that are then missing are brought in by flips.
//
// Source: the "conventional" or "traditional" subdivision of Xin et al. 2018, 4.1.2, 5.2 and figures 1, 8, 9; the
// three-way split of the earlier literature (Bielser et al. 2004 and others). Promises: the exact path, area,
// conforming, no vertex moved. Fails: shapes. A crossing at fraction t of an edge makes triangles of aspect ratio up to
// 2/t, without limit.
#pragma once

#include "harness/cut/cutting_method.h"

namespace cutbench {

class ConventionalSplit : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;

 private:
};

}  // namespace cutbench
