// Two of CISAMR's three phases, relocation and sub-triangulation: on a structured grid, vertices near the path move
// onto it, and the triangles that are still crossed are divided; then flips. It is not the method of its source, and
// says nothing about that one's bound.
//
// How it works: for sheets of which at least half of the triangles are halves of equal squares along the axes; others
// are refused. adapt: where a crossing lies at up to half its edge from an end, that end moves to the nearest crossing
// of any of its edges, nearest first (methods/tools/warp.h: where the incision stays within the tolerance of the
// requested curve, nothing else of the path meets the vertex's triangles, and no aspect ratio exceeds a million).
// embed: the Delaunay split of the triangles that are still crossed. improve: a quadrilateral that the moves left
// ill-shaped gets its better diagonal, until none changes.
//
// Source: Soghrati, Xiao and Nagarajan, A conforming to interface structured adaptive mesh refinement technique for
// modeling fracture problems, Computational Mechanics 59, 2017 (only the abstract was read). It names three phases:
// refinement of the background grid, relocation of the nodes of cut elements, sub-triangulation of these and of
// elements with hanging nodes; and "the required considerations for the treatment of crack tips and branching cracks".
// It claims that "aspect ratios of conforming elements are lower than three", without iterative smoothing or
// optimisation.
// What is left out here: the refinement, with its hanging nodes, and every treatment of tips and branches, since the
// abstract does not say what they are. What is ours: that vertices move to crossings of their own edges, the tolerance
// of the path, the Delaunay split of what is still crossed, flips until none changes. So no aspect ratio is promised,
// and none measured here judges the source.
// Promises: area, conforming; neither the exact path (between moved vertices it takes short cuts) nor that vertices
// stay. The incision error is at most the chord tolerance, since every move is checked against the requested curve.
// Where it fails: on any other sheet; where two moved vertices face each other; at tips and corners of the path, to
// which nothing moves; beside older incisions, whose vertices stay.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class Cisamr : public CuttingMethod {
 public:
  /// \param tolerance  of the path between moved vertices, mean rest edges; the chord tolerance where that is smaller
  explicit Cisamr(double tolerance)
      : warp_({.reach = 0.5, .max_aspect = 1e6, .tolerance = tolerance}), reshape_({.tolerance = tolerance}) {}

  std::optional<std::string> why_unsupported(const Sheet& sheet) const override;
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes&) override;

 private:
  Warp warp_;
  PathCurve curve_;
  Reshape reshape_;
};

}  // namespace cutbench
