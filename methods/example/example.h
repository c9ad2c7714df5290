// An example of a method, the smallest one with an embedding of its own: start yours from a copy.
//
// How it works: a crossing leaves a quadrilateral of the crossed triangle, which is divided by its shorter diagonal
// (where both are equally long, by the one from the point that the path met first). All other crossed triangles are
// divided step by step (split_step_by_step() in harness/cut/delaunay_split.h).
//
// Source: the shorter diagonal is the usual choice without a circumcircle test.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: shapes, as every split without new or moved vertices: a crossing at fraction t of an edge makes
// triangles of aspect ratio about 1/t. The shorter diagonal is not always the one with the larger smallest angle.
#pragma once

#include "harness/cut/cutting_method.h"
#include "harness/cut/delaunay_split.h"

namespace cutbench {

class Example : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
};

}  // namespace cutbench
