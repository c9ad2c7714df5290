// The whole sheet is meshed again with the path in it: what one does without a cutting method. A baseline.
//
// How it works. embed: the Delaunay split. improve: only the vertices on the border, on older incisions and on the path
// are kept, and held ones (pinned or loaded). CGAL's mesh generator fills the sheet with new triangles, as large as the
// old ones in the mean and of aspect ratios up to 3, and adds points on border and incisions where it needs them
// (methods/tools/region_mesher.h). The deformed position of a new vertex is interpolated in the old triangle that holds
// it. The path keeps the points where it crossed the old edges, so that the incision is the same as that of every other
// method with an exact incision.
//
// Source: as harness/problems/common/body_fitted.cpp; CGAL 5.5, Delaunay_mesher_2.
// Promises: the exact path, area, conforming; not that vertices stay.
// Where it fails: the cost depends on the sheet and not on the cut. All data of vertices and triangles are lost: the
// state is interpolated everywhere, once more with each cut. Crossings close together on the path stay, with small
// triangles round them. A graded sheet loses its grading. Where doubles are too coarse for the mesh generator, two
// vertices lie at one place, or it needs more than four new vertices a triangle plus a thousand, the triangles of the
// Delaunay split stay.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/region_mesher.h"

namespace cutbench {

class GlobalRemesh : public CuttingMethod {
 public:
  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  ForcedWedges wedges_;
  RegionMesher mesher_;
  Region sheet_;
};

}  // namespace cutbench
