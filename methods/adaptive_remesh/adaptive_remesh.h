// Adaptive remeshing: the triangles round the cut follow a size field that is fine at the tips.
//
// How it works. embed: the Delaunay split. improve: in a zone round the path, edges are split, flipped and collapsed in
// turn, by a size field (methods/adaptive_remesh/size_field.h: fine at tips, and where the deformed sheet is curved,
// compressed, or moves at a velocity that varies). It ends when a round changes nothing, after ten rounds, or with 20
// new vertices for each of the path and 1,000 more:
//  - an edge longer than sqrt(2) times the field at its middle is divided there, also one of the path, an incision or
//    the border;
//  - an edge that separates nothing is flipped where it is not Delaunay (exact in_circle), unless the deformed sheet is
//    bent there by 40 degrees or more;
//  - an edge shorter than 1 / sqrt(2) of it is collapsed, where no edge becomes longer than that and those that were
//    there, and no triangle gets an aspect ratio beyond 6 and those that were there (twice those, if the edge is
//    shorter than a quarter of the field).
// The zone is what the split changed, and the triangles in the reach of the path's tips, and of tips of earlier cuts at
// which the path goes on: behind the blade, where these are tips no more, collapses make the mesh coarse again. The
// zone does not grow, so that the cost follows the triangles near the cut.
//
// A vertex of the path goes where the edge that replaces its two stays within the tolerance of the curve that was asked
// for, and an edge of the path is divided at a point of that curve where that is possible, else at its middle
// (methods/tools/path_curve.h): the licence that warp_and_refine has. `adaptive_remesh:tolerance` with 0 has none:
// there only a vertex inside a straight piece goes.
//
// Frozen: border and older incisions stay where they are, with their vertices, and so do held vertices (Sheet::hold).
// Sheet::flip and Sheet::collapse refuse by exact predicates what would turn a triangle over, so the area stays.
//
// Source: Narain, Samii and O'Brien, Adaptive anisotropic remeshing for cloth simulation, ACM TOG 31(6), 2012 (split,
// flip, collapse; not read, but dynamicremesh.cpp of their program ARCSim); Pfaff, Narain, de Joya, O'Brien, Adaptive
// tearing and cracking of thin sheets, ACM TOG 33(4), 2014 (fine at tips, coarse behind; not read). As in ARCSim no
// edge of a fold is flipped, vertices of the border and of older incisions do not go, and the field has terms of
// curvature, compression, velocity and stress (methods/adaptive_remesh/deformed_metric.h).
// Not as there (the whole program as a reviewer read it): those vertices of the border that remeshing made may go along
// it. It remeshes the sheet once a frame, and where it tears what is about to tear with two rings round it; here it is
// the zone of a cut. Its tears move a vertex onto a line that they pass closely, and do not split there; here all
// crossings are split first, and collapses remove what is too short. A collapse may leave an aspect ratio of 6; there
// 12 sqrt(3) area / perimeter^2 is 0.2 in examples of cloth, which is 12 to 13, and 0.3 in one of tearing. Its field is
// a tensor, here it is a number, without terms of obstacles and plasticity. It splits above 1 and makes no edge longer
// than 0.9 by a collapse, which has no lower bound, here both bounds are those of a quasi-unit mesh (Frey and George,
// Mesh Generation, 2000; not read), so that it keeps its own resolution. Its flips weigh the field, here they are those
// of Delaunay. Nothing is moved but a vertex on a straight border, onto the end of a path close by, which is the
// collapse of the edge between the two. Its filter against the pop of remeshing (popfilter.cpp) is left out.
// Promises: area, conforming, an incision within the chord tolerance of the curve; neither the exact path nor that
// vertices stay: those too close together are removed, and what they carried is lost.
// Where it fails: no aspect ratio is promised. Vertices of the border and of older incisions stay, however close
// together, with short edges and needles between them; behind the blade the lips of the incision stay as fine as they
// were at the tip. In a graded sheet the mean edge is too large here and too small there. Flips and collapses of old
// edges change the deformed surface where the sheet is bent. Fine triangles at the tip have eigenvalues of
// (h / h_tip)^2 times those of the sheet. Tips of hundreds of cuts in one place fill it with fine triangles, each of
// which is measured from all of them.
#pragma once

#include <numbers>
#include <vector>

#include "harness/cut/cutting_method.h"
#include "harness/mesh/stamped_table.h"
#include "methods/adaptive_remesh/deformed_metric.h"
#include "methods/adaptive_remesh/size_field.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/warp.h"

namespace cutbench {

class AdaptiveRemesh : public CuttingMethod {
 public:
  struct Options {
    double tip = 0.2;                   ///< h_tip: the field at a tip, mean rest edges, in (0, 1]; 0: flips alone
    double growth = 0.3;                ///< g: of the field with the distance from the tip
    double tolerance = path_tolerance;  ///< of the path (path_curve.h); 0: it keeps every crossing
    DeformedTerms deformed = {};        ///< of the field
  };
  explicit AdaptiveRemesh(const Options& options)
      : options_(options), warp_({.reach = 0.35, .tolerance = options.tolerance, .border_only = true}) {}

  void see(const Motion* motion) override { state_.see(motion); }
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;

  static constexpr double longest = std::numbers::sqrt2, shortest = 1 / longest;  ///< edges that fit, over the field

 private:
  bool flips_alone() const { return options_.tip == 0; }
  void find_zone(const Sheet& sheet);
  void find_metrics(const Sheet& sheet);
  void flood(const Sheet& sheet, double radius);
  void add_star(const Sheet& sheet, VertexIndex v);
  void add(TriangleIndex t);
  bool split_long(Sheet& sheet, std::size_t most_vertices);
  bool split(Sheet& sheet, HalfEdge h);
  void flip(Sheet& sheet);
  bool collapse_short(Sheet& sheet);
  bool may_go(const Sheet& sheet, HalfEdge h) const;
  double worst_after_collapse(const Sheet& sheet, HalfEdge h) const;

  Options options_;
  PathCurve curve_;
  Warp warp_;
  double tolerance_ = 0;  // rest units
  SizeField field_;
  DeformedState state_;
  StampedTable<TriangleIndex, double> metric_of_;
  StampedSet<VertexIndex> measured_;
  std::vector<TriangleIndex> zone_;
  StampedSet<TriangleIndex> in_zone_;
  std::vector<TriangleIndex> doubtful_;  // changed since the last flips
  std::vector<HalfEdge> open_;
  std::vector<VertexIndex> reached_;  // by the flood, its sources first
  StampedTable<VertexIndex, double> distance_;
};

}  // namespace cutbench
