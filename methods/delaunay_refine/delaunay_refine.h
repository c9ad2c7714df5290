// Delaunay refinement round the cut, on the sheet itself: as cgal_refine, but local, so that its cost depends on the
// cut and not on a region round it.
//
// How it works. embed: the Delaunay split. improve: edges round the new vertices are flipped to constrained Delaunay
// where they may be flipped; then triangles that the cut made or changed, and whose aspect ratio exceeds `bound`, are
// refined by off-centres (methods/tools/delaunay_refinement.h). Those in forced wedges (methods/tools/forced_wedges.h)
// are not refined.
//
// Source: Ruppert 1995 and Ungor 2004, as cited there.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: termination is not proved for an aspect ratio of 3. So there is a limit on vertices, at which it
// stops and leaves the remaining triangles. A vertex close to the path stays and costs dozens of vertices round it, the
// smallest triangles as small as its distance from the path. Flips of old edges change the deformed surface where the
// sheet is bent.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/delaunay_refinement.h"

namespace cutbench {

class DelaunayRefine : public CuttingMethod {
 public:
  explicit DelaunayRefine(const DelaunayRefinement::Options& options) : refinement_(options) {}

  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  ForcedWedges wedges_;
  DelaunayRefinement refinement_;
};

}  // namespace cutbench
