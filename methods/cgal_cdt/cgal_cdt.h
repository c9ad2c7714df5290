// CGAL's constrained Delaunay triangulation of the strip of crossed triangles.
//
// How it works: the strip's vertices and the path's points are inserted into a CGAL triangulation, the strip's border,
// the path and older incision edges are constraints; what lies inside the strip replaces it. The trace's crossing
// points stay, so the incision is the same as every other method's; the edges between old vertices inside the strip are
// free to change, which the triangle by triangle methods don't allow themselves.
//
// Source: CGAL 5.5, Constrained_Delaunay_triangulation_2 with the Epick kernel.
// Promises: the exact path, area, conforming, no vertex moved.
// Fails: no points are added, so a point near a vertex or an edge still makes a thin triangle; flips across old edges
// change the deformed surface where the strip is bent.
#pragma once

#include <memory>

#include "harness/cut/cutting_method.h"

namespace cutbench {

class CgalCdt : public CuttingMethod {
 public:
  CgalCdt();
  ~CgalCdt() override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes&) override;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace cutbench
