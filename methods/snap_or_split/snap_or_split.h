// Snap or split: a crossing near a vertex moves to the vertex, the others are split.
//
// How it works. adapt: crossings whose distance from an end of their edge is at most `tolerance` of the edge are taken
// nearest first, each together with its neighbours on the path that cross other edges of the same vertex as near to it;
// the path goes through the vertex instead (methods/tools/path_graph.h). Before that a tip goes to a vertex as near as
// that, one for which its barycentric coordinate is at least 1 - `tolerance`, with the crossings on the way. embed: the
// Delaunay split of the triangles that are still crossed. Corners and crossings inside triangles stay where they are,
// and so do tips that are near an edge, but to no vertex. A snap that would change the pieces of the sheet is not made,
// and the crossing is split, the tip stays: where the path would touch itself, the border or an older incision, or
// leave one; where it would run along the border; where it would close a loop or a corner that is cut off; where a
// single edge between tips would be left.
//
// Source: SOFA's snapping thresholds (TriangleSetTopologyAlgorithms.inl, read: SnapBorderPath gives a path's end inside
// a triangle to a corner within the threshold, and to no edge inside the sheet; to one of the border, which is not done
// here, since it would cut through). Related: Steinemann, Harders, Gross and Szekely, Hybrid cutting of deformable
// solids, IEEE VR 2006 (not read), who mix snapping and splitting, too.
// Promises: area, conforming, no vertex moved; not the exact path. A crossing moves by at most `tolerance` of its edge,
// and a tip by that of the longer edge at the vertex, which is at most one half, so the incision error is at most half
// the sheet's longest edge plus the chord tolerance.
// Where it fails: the incision has kinks. Away from tips and from crossings that may not be snapped, a crossing makes
// triangles of aspect ratio up to about 2 / tolerance; a tip that comes near the middle of an edge leaves a sliver. A
// path cut twice is two incisions: the second one crosses the first, which lies elsewhere. A later path that meets the
// kinks at a small angle may cross them more than once, so that small pieces come off that the exact paths do not cut
// off.
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
