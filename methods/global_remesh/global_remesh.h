// The whole sheet meshed anew with the path in it: what one does who has no cutting method. A baseline.
//
// How it works. embed: crossed triangles are divided along the path. improve: of the whole sheet only the vertices on
// the border, on older incisions and on the path are kept, and held ones (pinned or loaded); CGAL's mesh generator
// fills it with new triangles, as large as the sheet's were in the mean and of aspect ratios up to 3, and puts points
// on border and incisions where it wants them (methods/tools/region_mesher.h). The deformation at a new vertex is that
// of the old triangle it lies in. The path keeps the points where it crossed the old edges, so that the incision is the
// same as every other method's.
//
// Source: as harness/truth/body_fitted.cpp; CGAL 5.5, Delaunay_mesher_2.
// Promises: the exact path, area, conforming; not that vertices stay.
// Fails: costs the sheet and not the cut, and everything that belonged to vertices and triangles is lost: the state is
// interpolated everywhere, anew with each cut. Crossings near each other on the path stay as near, with small triangles
// round them. A graded sheet loses its grading. Where doubles are too coarse for the mesh generator, two vertices lie
// at one place, or it doesn't come to an end within four new vertices a triangle and a thousand, the plain split stays.
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
