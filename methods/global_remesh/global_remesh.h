// The whole sheet is meshed again with the path in it: what one does without a cutting method. A baseline.
//
// How it works. adapt: a vertex on a straight border that the path passes closely moves to the end of the path
// (methods/tools/warp.h). embed: the Delaunay split. improve: vertices of the path are left out where its edges then
// stay within the tolerance of the curve and are no longer than the new triangles' (methods/tools/path_curve.h): the
// licence that warp_and_refine has. Of the others only those on the border, on older incisions and on the path are
// kept, and held ones (pinned or loaded). CGAL's mesh generator fills the sheet with new triangles, as large as the
// old ones in the mean and of aspect ratios up to 3, and adds points on border and incisions where it needs them
// (methods/tools/region_mesher.h). The deformed position of a new vertex is interpolated in the old triangle that
// holds it. `global_remesh:tolerance` with 0 keeps the points where the path crossed the old edges.
//
// Source: as harness/problems/common/body_fitted.cpp; CGAL 5.5, Delaunay_mesher_2.
// Promises: area, conforming, an incision within the chord tolerance of the curve; not that vertices stay.
// Where it fails: the cost depends on the sheet and not on the cut. All data of vertices and triangles are lost: the
// state is interpolated everywhere, once more with each cut. A graded sheet loses its grading. Where doubles are too
// coarse for the mesh generator, two vertices lie at one place, or it needs more than four new vertices a triangle
// plus a thousand, the triangles of the Delaunay split stay.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/region_mesher.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class GlobalRemesh : public CuttingMethod {
 public:
  /// \param tolerance  largest distance of the path that was asked for from its edges, mean rest edges; the chord
  ///                   tolerance where that is smaller; 0: the path keeps every crossing
  explicit GlobalRemesh(double tolerance)
      : simplifies_(tolerance > 0),
        warp_({.reach = 0.35, .tolerance = tolerance, .border_only = true}),
        reshape_({.tolerance = tolerance}) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  void simplify_path(Sheet& sheet, double longest);

  bool simplifies_;
  PathCurve curve_;
  Warp warp_;
  Reshape reshape_;
  ForcedWedges wedges_;
  RegionMesher mesher_;
  Region sheet_;
};

}  // namespace cutbench
