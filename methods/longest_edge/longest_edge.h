// Local split by longest edges (LEPP-Delaunay without its operations at the boundary), in place of the paper's; it is
// no reading of that one.
//
// How it works. embed: the Delaunay split. improve: edges round the new vertices are flipped to constrained Delaunay.
// Then, for each triangle that the cut made or changed and whose aspect ratio exceeds 3, the longest-edge propagation
// path is followed, from neighbour to neighbour across ever longer edges, to an edge that is the longest of both its
// triangles or lies on the border. Its midpoint becomes a vertex, and edges round that are flipped to Delaunay, never
// border, incisions or path. This goes on in the order in which triangles were found, until no triangle is ill-shaped
// or the split has made `cap` vertices per vertex of the path. Edges shorter than twice `min_edge` are not split, nor
// are triangles in a forced wedge (methods/tools/forced_wedges.h).
//
// Source: Rivara, New longest-edge algorithms for the refinement and/or improvement of unstructured triangulations,
// 1997 (LEPP-Delaunay; not read); Bedregal and Rivara, Procedia Engineering 124, 2015 (abstract read); Xin et al. 2018,
// 4.1.3, for the step that it replaces. Flips: harness/mesh/local_delaunay.h.
// Not as there: the authors insert points of their own where a midpoint comes close to the boundary, against
// non-convergence. With these, angles above 25.66 degrees are proved where constrained angles are 30 degrees or more,
// which is an aspect ratio up to about 4.2. So what fails here does not judge the source.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: 3 is not reached in most cuts: it goes on halving edges beside a constrained edge that a new midpoint
// encroaches upon. Hence the strict cap. It is reached in most cuts, which is reported as stopping early: the cost is
// then that of the cap. A vertex close to the path costs dozens of vertices, and the small distance itself stays. Flips
// of old edges change the deformed surface where the sheet is bent.
#pragma once

#include "harness/cut/cutting_method.h"
#include "harness/mesh/local_delaunay.h"
#include "methods/tools/forced_wedges.h"

namespace cutbench {

class LongestEdge : public CuttingMethod {
 public:
  struct Options {
    double cap = 8;          ///< vertices that the split may make, per vertex of the path
    double max_aspect = 3;   ///< a triangle beyond it is ill-shaped
    double min_edge = 1e-2;  ///< no edge is made shorter than this, in mean rest edges
  };
  explicit LongestEdge(const Options& options) : options_(options) {}

  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  bool wants_splitting(const Sheet& sheet, TriangleIndex t) const;
  bool split_terminal_edge(Sheet& sheet, TriangleIndex t);
  void note_changed(const Sheet& sheet);

  Options options_;
  ForcedWedges wedges_;
  LocalDelaunay delaunay_;
  std::vector<TriangleIndex> ill_shaped_;  // a queue; a triangle may be well-shaped or gone when its turn comes
};

}  // namespace cutbench
