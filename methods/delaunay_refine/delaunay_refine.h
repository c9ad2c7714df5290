// Delaunay refinement of the cut's surroundings, on the sheet itself: what CGAL's mesh generator does (cgal_refine),
// but local, so that its cost follows the cut.
//
// How it works. embed: crossed triangles are divided along the path. improve: edges round the new vertices are flipped
// to constrained Delaunay, as far as they may; then triangles that the cut made or changed, and whose aspect ratio
// exceeds `bound`, are refined by off-centres (methods/tools/delaunay_refinement.h). Those in forced wedges
// (methods/tools/forced_wedges.h) are left coarse.
//
// Source: Ruppert 1995 and Ungor 2004, as said there.
// Promises: the exact path, area, conforming, no vertex moved.
// Fails: an aspect ratio of 3 is beyond what is proved to end, hence a limit on vertices, at which it stops and leaves
// the rest. A vertex close to the path stays where it is and costs dozens of vertices round it, the smallest of them as
// near to each other as it is to the path. Flips across old edges change the deformed surface where the sheet is bent.
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
