// Improves the triangles round an embedded path that is still closed: removes short edges at the path, flips edges,
// moves vertices, and where that is not enough splits edges and refines triangles. Each step is one of the sheet's
// editing calls, which exact orientation tests accept or refuse. So whatever is done, the path stays embedded and
// separates what it separated.
#pragma once

#include <array>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/mesh/tolerances.h"
#include "methods/tools/delaunay_refinement.h"
#include "methods/tools/forced_wedges.h"
#include "methods/tools/path_curve.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class Reshape {
 public:
  struct Options {
    double short_edge = 0.35;           ///< an edge at the path is too short below it, in mean rest edges
    double max_aspect = 3;              ///< a triangle at or beyond it is ill-shaped
    double tolerance = path_tolerance;  ///< of the trace's nodes from the edges that replace them (path_curve.h)
    double min_edge =
        shortest_refined_edge;  ///< no piece of path, incision or border shorter than twice that is divided
  };
  explicit Reshape(const Options& options)
      : options_(options), refinement_({.bound = options.max_aspect, .min_edge = options.min_edge}) {}

  /// \pre begin_cut() was called, and the path is embedded; `curve` knows its vertices.
  void begin(Sheet& sheet, PathCurve& curve);

  /// Removes one end of each edge at the path that is too short: a vertex of the path, where the edge that replaces it
  /// stays within the tolerance of the curve, or a vertex beside the path that may move.
  void thin();
  /// Flips an edge of each ill-shaped triangle where that makes the worse of the two triangles better. With
  /// `smoothing`, also moves its corners, those on the path along the curve, others freely; and first treats sharp
  /// corners, where the path and an older incision, the border or the path itself enclose a smaller angle than a
  /// well-shaped triangle needs. Chords may enclose less than the curves: then the first piece of the path is turned
  /// away from the other leg, within the tolerance. Where the curves themselves enclose too little, the path is made to
  /// follow its curve more closely, so that the triangles that have to be ill-shaped stay in the wedge of the curves.
  void flip_and_smooth(bool smoothing);
  /// For each triangle that is still ill-shaped: removes a corner, moves the vertices round it, or splits an edge (a
  /// piece of the path at a point of the curve); then refines the remaining ones by Delaunay refinement. False where
  /// that did not end within a budget.
  bool refine();

  /// Ill-shaped, and not in a forced wedge.
  bool is_ill_shaped(TriangleIndex t) const;
  /// Triangles that the cut has made or changed so far.
  std::vector<TriangleIndex> changed_triangles() const;

  /// How a vertex may move.
  enum class Freedom : std::uint8_t { none, along, free };
  struct Neighbours {
    VertexIndex before, after;  ///< on the path, in either direction; set where the freedom is `along`
  };
  Freedom freedom(VertexIndex v, Neighbours& neighbours) const;
  /// Whether the path allows that the edge `towards` is collapsed, by moving its origin v to its target: what is left
  /// out stays within the tolerance of the curve.
  bool may_leave_out(VertexIndex v, HalfEdge towards) const;
  /// Whether the segment a b may stand for the curve between these parameters.
  bool is_near_curve(double from, double to, Point2 a, Point2 b) const {
    return curve_->stays_near(from, to, a, b, tolerance_);
  }
  /// Splits an edge with a new vertex at p, which may lie beside it; invalid, unchanged, where a triangle would not
  /// stay positive.
  VertexIndex split_at(HalfEdge h, Point2 p);

 private:
  bool is_tip(VertexIndex v) const;
  double worst_after_collapse(HalfEdge h) const;
  bool shorten_at(VertexIndex v);
  bool flip_one(TriangleIndex t);
  bool smooth(VertexIndex v);
  bool slide(VertexIndex v, const Neighbours& neighbours);
  bool turn_away(VertexIndex v, VertexIndex apex, VertexIndex other);
  void follow_closely(VertexIndex from, VertexIndex to);
  void widen_corners();
  void find_wedges(bool widen);
  bool smooth_round(TriangleIndex t);
  bool shorten_in(TriangleIndex t);
  bool split_in(TriangleIndex t);
  void improve_one_by_one();
  void note_star(VertexIndex v);
  void process_queue(bool smoothing, std::size_t most);

  Options options_;
  Sheet* sheet_ = nullptr;
  PathCurve* curve_ = nullptr;
  ForcedWedges wedges_{0.5};  // wider than default: the mesh's legs are chords, which differ from the curves
  DelaunayRefinement refinement_;
  double h_ = 0, tolerance_ = 0;
  std::vector<TriangleIndex> queue_, stuck_;
  std::vector<VertexIndex> ring_;
  std::vector<std::array<VertexIndex, 3>> corners_;  // apex, right, left
};

}  // namespace cutbench
