// Moves vertices that the path passes closely onto it, before anything is split. Their edges are then no longer
// crossed, so the thin triangles that the split would make there do not arise.
#pragma once

#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/path_graph.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class Warp {
 public:
  struct Options {
    double reach = 0.4;                 ///< of an edge, from a vertex to the crossing it moves for
    double max_aspect = 4;              ///< no triangle round a moved vertex may exceed it
    double tolerance = path_tolerance;  ///< of nodes that are left out from the new path (path_curve.h)
    bool border_only = false;           ///< only vertices on the border move
  };
  explicit Warp(const Options& options) : options_(options) {}

  /// Crossings at most `reach` of their edge from its end are taken nearest first. That end moves to one of the
  /// crossings on its edges, which are points of the exact path: the nearest for which no aspect ratio exceeds
  /// `max_aspect` and the new path stays within the tolerances of the curve. The path then goes through the vertex,
  /// whose edges are no longer crossed. A vertex moves once, and only where the path passes it in one piece
  /// (PathGraph::find_run, has_star_to_itself). A vertex on the border moves only along it, where that is straight;
  /// held vertices, those on incisions and those of more than 64 crossed outgoing edges stay. The deformed position is
  /// that of the same material point before (Sheet::move). On return the trace is that of the sheet as it then is.
  /// \pre curve.read() of the same trace
  void run(Sheet& sheet, Subdivision& trace, const PathCurve& curve);

 private:
  /// Nodes first..last of the trace, which a node of the graph stands for, and the one of them at whose point it lies.
  struct Share {
    int first, last, at;
  };
  const Share& share(int node) const { return shares_[to_size(node)]; }
  Share share_of_run() const;
  int move_to_path(Sheet& sheet, const PathCurve& curve);
  bool stays_near(int target, const PathCurve& curve) const;

  Options options_;
  PathGraph path_;
  PathGraph::Run run_;
  std::vector<int> targets_;   // nodes
  std::vector<Share> shares_;  // per node of the graph
  double tolerance_ = 0;       // rest units
};

}  // namespace cutbench
