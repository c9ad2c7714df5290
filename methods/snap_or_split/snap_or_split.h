// Snap or split: a crossing near a vertex moves to the vertex, the others are split.
//
// How it works: crossings whose distance to an end of their edge is at most `tolerance` of the edge are taken nearest
// first, each together with its neighbours on the path that cross other edges of the same vertex as near to it; the
// path goes through the vertex instead (methods/tools/path_graph.h). What is left is embedded as it is: the Delaunay
// diagonal in each crossed triangle, no flips. Tips, corners and crossings inside triangles stay where they are.
// A snap that would change how the sheet falls apart is not made, and the crossing is split: where the path would touch
// itself, the border or an older incision, or leave one; where it would go along the border; where a loop or a cut-off
// corner would close up.
//
// Source: Steinemann et al., Fast arbitrary splitting of deforming objects, 2006, as others describe it; SOFA's
// snapping thresholds (TriangleSetTopologyAlgorithms). Promises: area, conforming, no vertex moved; not the exact path.
// Fails: the incision strays from the path by up to `tolerance` of an edge and has kinks. Away from tips and from what
// may not be snapped, a crossing makes triangles of aspect ratio up to about 2 / tolerance; tips keep their slivers. A
// path cut twice is two incisions: the second one crosses the first, which is elsewhere; and a later path that meets
// the kinks at a small angle may cross them more than once, so that bits fall off that nobody asked for.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_graph.h"

namespace cutbench {

class SnapOrSplit : public CuttingMethod {
 public:
  explicit SnapOrSplit(double tolerance) : tolerance_(tolerance) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline&) override;

 private:
  double tolerance_;  // in edge lengths
  PathGraph path_;
};

}  // namespace cutbench
