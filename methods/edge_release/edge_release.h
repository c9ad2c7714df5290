// Edge release: the path is rounded to existing edges, which are then opened. A baseline.
//
// How it works. adapt: points of the path inside triangles are left out, and every crossing of an edge goes to one of
// the edge's ends, the nearer one where possible, nearest first, together with its neighbours on the path that cross
// other edges of the same vertex. The path is then a chain of edges: a staircase on a regular grid. A tip goes to a
// vertex of the triangle or edge that it lies in: to the nearest where possible, so that the released edges end there
// and make no triangles. A step is made only where the sheet keeps the pieces that the exact path makes
// (methods/tools/path_graph.h): where rounding would make the path touch itself, the border or an older incision, or
// would close a loop or a corner that is cut off, or would leave a single edge between two tips, which does not open,
// the crossing is split instead, and the tip stays; so does the end of a blade that goes on. embed: the Delaunay split
// of the triangles that are still crossed.
//
// Source: libigl's cut_mesh and cloth tearing, which release edges and nothing else; Nienhuys and van der Stappen,
// Combining finite element deformation with cutting for surgery simulations, Eurographics 2000 (not read), whose cut
// was jagged by the authors' page. (Their version of 2001 moves nodes, too, as vertex_snap does.) How each rounds a tip
// was not found in a text.
// Promises: area, conforming, no vertex moved; not the exact path. The incision error is at most the sheet's longest
// edge plus the chord tolerance, since a crossing moves along its own edge at most to that edge's other end, and a tip
// stays in its own triangle. Measured: at most 1.6 mean edges on sheets whose edges differ in length.
// Where it fails: the incision is longer than the path by a factor that a finer sheet does not reduce (up to the square
// root of 2 on a grid). A new cut from where an older one was to end begins elsewhere: an edge may be left between
// them. A later path that meets the staircase at a small angle crosses it more than once, so that small pieces come off
// that the exact paths do not cut off. Shapes are those of the sheet except where a crossing had to be split.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_graph.h"

namespace cutbench {

class EdgeRelease : public CuttingMethod {
 public:
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline&) override;

 private:
  PathGraph path_;
  PathGraph::Run run_;
};

}  // namespace cutbench
