// Snap or split: a crossing near a vertex moves to the vertex, the others are split.
//
// How it works. adapt: crossings whose distance from an end of their edge is at most `tolerance` of the edge are taken
// nearest first, each together with its neighbours on the path that cross other edges of the same vertex as near to it;
// the path goes through the vertex instead (methods/tools/path_graph.h). embed: the Delaunay split of the triangles
// that are still crossed. Tips, corners and crossings inside triangles stay where they are. A snap that would change
// the pieces of the sheet is not made, and the crossing is split: where the path would touch itself, the border or an
// older incision, or leave one; where it would run along the border; where it would close a loop or a corner that is
// cut off.
//
// Source: Steinemann, Harders, Gross and Szekely, Hybrid cutting of deformable solids, IEEE VR 2006 (not read, as others
// describe it); SOFA's snapping thresholds (TriangleSetTopologyAlgorithms).
// Promises: area, conforming, no vertex moved; not the exact path. A crossing moves by at most `tolerance` of its edge,
// which is at most one half, so the incision error is at most half the sheet's longest edge plus the chord tolerance.
// Where it fails: the incision has kinks. Away from tips and from crossings that may not be snapped, a crossing makes
// triangles of aspect ratio up to about 2 / tolerance; at tips slivers stay. A path cut twice is two incisions: the
// second one crosses the first, which lies elsewhere. A later path that meets the kinks at a small angle may cross them
// more than once, so that small pieces come off that the exact paths do not cut off.
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
