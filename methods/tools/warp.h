// Moves vertices that the path passes closely onto it, before anything is split: all crossings of their edges are gone
// then, and with them the thin triangles that they would have made.
#pragma once

#include <optional>
#include <vector>

#include "harness/mesh/sheet.h"
#include "methods/tools/path_graph.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class Warp {
 public:
  struct Options {
    double reach = 0.4;       ///< of an edge, from a vertex to the crossing it moves for
    double max_aspect = 4;    ///< no triangle is pressed beyond it
    double tolerance = 0.05;  ///< of the path that is left out, from the new way, where the trace has no smaller one;
                              ///< mean rest edges
  };
  explicit Warp(const Options& options) : options_(options) {}

  /// Crossings at most `reach` of their edge from its end are taken nearest first. That end goes to one of the
  /// crossings on its edges, points of the exact path, the nearest that presses no triangle too flat; the path goes
  /// through it there, and what was crossed round it is crossed no more. A vertex moves once, only where the path
  /// passes it in one go (PathGraph::find_run, has_star_to_itself); one on the border only along it, where that is
  /// straight; held ones, those on incisions and those of more than 64 crossed outgoing edges stay. The deformed
  /// position is that of the same material point before (Sheet::move). The trace becomes that of the sheet as it is
  /// then.
  void run(Sheet& sheet, Subdivision& trace);

 private:
  bool move_to_path(Sheet& sheet);
  bool stays_near(Point2 to) const;

  Options options_;
  PathGraph path_;
  PathGraph::Run run_;
  std::vector<Point2> targets_;
  double tolerance_ = 0;  // rest units
};

}  // namespace cutbench
