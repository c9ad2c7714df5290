// Conventional split: the reference that every other method is compared with.
//
// How it works: the static split of methods/tools/static_split.h. A triangle crossed by the path through two edges
// becomes three, one in which the path goes from a corner to the opposite edge becomes two, and one in which it ends
// becomes four, in an order that does not depend on the shapes.
//
// Source: the "conventional" or "traditional" subdivision of Xin et al. 2018, 4.1.2, 5.2 and figures 1, 8, 9,
// which divides a triangle into three along the path. Which diagonal is theirs is not said; from the entering point is
// our choice. (Bielser et al. 2004, whom they cite, divide tetrahedra; abstract read.)
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: shapes. A crossing at fraction t of an edge makes triangles of aspect ratio up to 2/t, without limit.
#pragma once

#include "harness/cut/cutting_method.h"

namespace cutbench {

class ConventionalSplit : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;

 private:
};

}  // namespace cutbench
