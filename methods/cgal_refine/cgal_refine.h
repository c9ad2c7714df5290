// Delaunay refinement by CGAL round the cut: the textbook answer to ill-shaped triangles.
//
// How it works. embed: the Delaunay split. improve: the triangles that the cut changed, with two rings of neighbours,
// are triangulated again by CGAL (constrained Delaunay) and refined by its mesh generator until no triangle has an
// aspect ratio above `bound`. Path, older incisions and the sheet's border are constraints; they get new points where
// the refinement asks for them (Ruppert's rule, with CGAL's clusters at small angles). Where the refinement would
// divide the region's border, the region grows by the triangles there and the refinement starts again
// (methods/tools/region_mesher.h), three times at most and only while the limit on vertices is not reached. Otherwise
// the triangles of the Delaunay split stay. Triangles all of whose edges are shorter than `min_edge`, and those in
// forced wedges (methods/tools/forced_wedges.h), are not refined.
//
// Source: Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, 1995; Shewchuk, Delaunay
// refinement algorithms for triangular mesh generation, 2002 (neither read); CGAL 5.5, Delaunay_mesher_2 with the Epick
// kernel.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: termination is proved for smallest angles up to 20.7 degrees where input angles are not small, which
// neither an aspect ratio of 3 nor a cut promises. So there is a limit on vertices, at which it stops and leaves the
// remaining triangles. A vertex close to the path stays and costs dozens of vertices round it, the smallest triangles
// as small as its distance from the path: the step of an explicit integrator shrinks as it does after the conventional
// split. Flips of old edges change the deformed surface where the sheet is bent.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/region_mesher.h"

namespace cutbench {

class CgalRefine : public CuttingMethod {
 public:
  struct Options {
    double bound = 3;                  ///< no aspect ratio beyond it; infinity: constrained Delaunay alone
    double min_edge = 1e-3;            ///< triangles with shorter edges alone are left, in mean rest edges
    int rings = 2;                     ///< of neighbours, to begin with
    int most_rings = 32;               ///< by which it grows at once
    std::size_t per_path_vertex = 20;  ///< vertices that the refinement may make, for each one of the path
    std::size_t most_vertices = 5000;  ///< and in all: a path with more to ask for leads across stacks of slivers
  };
  explicit CgalRefine(const Options& options) : options_(options) {}

  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  Options options_;
  ForcedWedges wedges_;
  RegionMesher mesher_;
  Region region_, across_;
};

}  // namespace cutbench
