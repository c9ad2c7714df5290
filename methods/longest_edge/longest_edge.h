// Local split by longest edges (LEPP-Delaunay), the best behaved reading of the paper's local split.
//
// How it works. embed: crossed triangles are divided along the path. improve: edges round the new vertices are flipped
// to constrained Delaunay; then, for each triangle that the cut made or changed and whose aspect ratio exceeds 3, the
// longest-edge propagation path is followed, from neighbour to neighbour across ever longer edges, to an edge that is
// the longest of both its triangles or lies on the border. Its midpoint becomes a vertex, edges round that are flipped
// to Delaunay, never across border, incisions or path, and so on, first come first served, until no triangle is
// ill-shaped or the split has made `cap` vertices per vertex of the path. Edges shorter than twice `min_edge` stay, and
// so does what lies in a forced wedge (methods/tools/forced_wedges.h).
//
// Source: Rivara, New longest-edge algorithms for the refinement and/or improvement of unstructured triangulations,
// 1997 (LEPP-Delaunay); Xin et al. 2018, 4.1.3 for the place it takes. Flips: harness/mesh/local_delaunay.h.
// Promises: the exact path, area, conforming, no vertex moved.
// Fails: no bound on the aspect ratio is proved for the midpoint variant, and 3 is beyond it in most cuts: it goes on
// halving edges beside a constrained edge that a new midpoint encroaches upon. Hence the strict cap, at which it stops
// and leaves what is left as it is, in most cuts, so that stopping is not reported as anything special. A vertex close
// to the path costs it dozens of vertices, and the small feature itself stays. Flips across old edges change the
// deformed surface where the sheet is bent.
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

  void improve(Sheet& sheet, MethodNotes&) override;

 private:
  bool wants_splitting(const Sheet& sheet, TriangleIndex t) const;
  bool split_terminal_edge(Sheet& sheet, TriangleIndex t);
  void note_changed(const Sheet& sheet);

  Options options_;
  ForcedWedges wedges_;
  LocalDelaunay delaunay_;
  std::vector<TriangleIndex> ill_shaped_;  // a queue; each may be mended or changed by the time it is looked at
};

}  // namespace cutbench
