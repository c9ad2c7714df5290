// CGAL's constrained Delaunay triangulation of the strip of crossed triangles.
//
// How it works: the strip's vertices and the path's points are inserted into a CGAL triangulation. The strip's border,
// the path and older incision edges are constraints. The triangles inside the strip replace it. The crossing points of
// the trace stay, so the incision is the same as that of every other method with an exact incision; edges between old
// vertices inside the strip may change, which methods that work triangle by triangle do not allow.
//
// Source: CGAL 5.5, Constrained_Delaunay_triangulation_2 with the Epick kernel.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: no points are added, so a point near a vertex or an edge still makes a thin triangle. Flips of old
// edges change the deformed surface where the strip is bent.
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
