// Edge release: the path is rounded to existing edges, which then come apart. A baseline.
//
// How it works: points of the path inside triangles are left out, and every crossing of an edge goes to one of the
// edge's ends, the nearer one where possible, nearest first, together with its neighbours on the path that cross other
// edges of the same vertex. What was a path through triangles is then a chain of edges: a staircase on a regular grid.
// All of it only where the sheet falls apart as it would by the exact path (methods/tools/path_graph.h): where rounding
// would make the path touch itself, the border or an older incision, or close up a loop or a cut-off corner, the
// crossing is split instead. Tips inside triangles or on edges stay, and the triangles there are divided.
//
// Source: libigl's cut_mesh and cloth tearing, which release edges and nothing else.
// Promises: area, conforming, no vertex moved; not the exact path.
// Fails: the incision strays from the path by up to an edge, and is longer than it by a factor that no finer sheet
// takes away (up to the square root of 2 on a grid). A later path that meets its stairs at a small angle crosses them
// more than once, and bits fall off that nobody asked for. Shapes are those of the sheet but where something had to be
// split.
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
