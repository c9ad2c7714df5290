// Better shapes round an embedded path, still closed: short edges at it go, edges are flipped, vertices moved a little,
// and where all that does not help, edges split and triangles refined. Each step is one of the sheet's editing calls,
// which the exact orientation of every triangle decides: whatever is done or left undone, the path stays embedded, and
// separates what it separated.
#pragma once

#include <array>
#include <vector>

#include "harness/mesh/sheet.h"
#include "methods/tools/delaunay_refinement.h"
#include "methods/tools/forced_wedges.h"
#include "methods/tools/path_curve.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class Reshape {
 public:
  struct Options {
    double short_edge = 0.35;  ///< an edge at the path is too short below it, in mean rest edges
    double max_aspect = 3;     ///< a triangle at or beyond it is ill-shaped
    double tolerance = 0.05;   ///< of the path from the edges that stand for it, where the trace has no smaller one;
                               ///< mean rest edges
    double min_edge = 1e-4;    ///< no piece of path, incision or border shorter than twice that is divided
  };
  explicit Reshape(const Options& options)
      : options_(options), refinement_({.bound = options.max_aspect, .min_edge = options.min_edge}) {}

  /// \pre begin_cut() was called, and the path is embedded; `curve` knows its vertices.
  void begin(Sheet& sheet, PathCurve& curve);

  /// Takes one end of each edge at the path that is too short out of the sheet: a vertex of the path, where it goes on
  /// from its neighbours within the tolerance, or one of the sheet beside it that nothing holds.
  void thin();
  /// Flips an edge of each ill-shaped triangle where that makes the worse of the two better; with `smoothing`, moves
  /// its corners, too: those of the path along the curve, others anywhere. Then also, before, at corners with older
  /// incisions, the border or itself where edges enclose less than a good triangle needs: turns the first piece of the
  /// path away from the other leg, within the tolerance, as chords may enclose less than the curves; where these
  /// enclose too little, too, makes it follow the curve more closely, so that what is ill-shaped for it stays in their
  /// wedge.
  void mend(bool smoothing);
  /// For each triangle that is still ill-shaped: takes a corner out, moves what stands round it, or splits an edge, a
  /// piece of the path at a point of the curve; Delaunay refinement of what that leaves. False where that did not end
  /// within a budget.
  bool refine();

  /// Ill-shaped, and not in a forced wedge.
  bool is_ill_shaped(TriangleIndex t) const;
  /// Triangles that the cut made or changed, as yet.
  std::vector<TriangleIndex> changed_triangles() const;

 private:
  /// How a vertex may move.
  enum class Freedom : std::uint8_t { none, along, free };
  struct Neighbours {
    VertexIndex before, after;  // on the path
  };
  Freedom freedom(VertexIndex v, Neighbours& neighbours) const;
  bool is_tip(VertexIndex v) const;
  bool may_leave_out(VertexIndex v, HalfEdge towards) const;
  double worst_after_collapse(HalfEdge h) const;
  bool shorten_at(VertexIndex v);
  bool flip_one(TriangleIndex t);
  bool smooth(VertexIndex v);
  bool slide(VertexIndex v, const Neighbours& neighbours);
  VertexIndex split_at(HalfEdge h, Point2 p);
  bool turn_away(VertexIndex v, VertexIndex apex, VertexIndex other);
  void follow_closely(VertexIndex from, VertexIndex to);
  void widen_corners();
  void find_wedges(bool widen);
  bool smooth_round(TriangleIndex t);
  bool shorten_in(TriangleIndex t);
  bool may_divide(double from, double to, Point2 a, Point2 b) const;
  bool split_in(TriangleIndex t);
  void mend_one_by_one();
  void note_star(VertexIndex v);
  void settle(bool smoothing, std::size_t most);

  Options options_;
  Sheet* sheet_ = nullptr;
  PathCurve* curve_ = nullptr;
  ForcedWedges wedges_{0.5};  // the mesh's legs are chords, and its wedges not quite those of the curves
  DelaunayRefinement refinement_;
  double h_ = 0, tolerance_ = 0;
  std::vector<TriangleIndex> queue_, stuck_;
  std::vector<VertexIndex> ring_;
  std::vector<std::array<VertexIndex, 3>> corners_;  // apex, right, left
};

}  // namespace cutbench
