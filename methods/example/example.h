// An example of a method, written by the checklist in the README ("Add a method"): start yours from a copy.
//
// How it works: a crossing leaves a quadrilateral of the crossed triangle, which is divided by its shorter diagonal (on
// a tie by the one from the point the path met first). All other crossed triangles are divided step by step
// (split_step_by_step() in harness/cut/delaunay_split.h).
//
// Source: the shorter diagonal is what one takes who has no circle test at hand. Promises: the exact path, area,
// conforming, no vertex moved. Fails: shapes, as any split without new or moved points: a crossing at fraction t of an
// edge makes triangles of aspect ratio about 1/t. The shorter diagonal isn't always that of the larger smallest angle.
#pragma once

#include "harness/cut/cutting_method.h"
#include "harness/cut/delaunay_split.h"

namespace cutbench {

class Example : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;

 private:
};

}  // namespace cutbench
