// Warp and refine: the project's own method. Vertices move onto the path before the split, and triangles that are still
// ill-shaped afterwards are improved.
//
// How it works. adapt: vertices that the path passes within `reach` of an edge move to a point of the exact path
// (methods/tools/warp.h). embed: the Delaunay split of the triangles that are still crossed. improve
// (methods/tools/reshape.h), outside forced wedges:
//  - Thinning removes edges at the path shorter than 0.35 mean rest edges, where one end is a vertex of the path that
//    may be left out, or one of the sheet beside it.
//  - Flips make the worse of two triangles better, and the corners of ill-shaped triangles move; those on the path move
//    along the requested curve.
//  - Of the triangles that are still ill-shaped, edges are divided; the last step is Delaunay refinement
//    (methods/tools/delaunay_refinement.h).
// At a corner with an older incision, the border or the path itself, the first edge of the path is turned, within the
// tolerance, where it leaves less room for a well-shaped triangle than the curve. Every step is decided by exact
// predicates and leaves the path embedded, so that a triangle that cannot be improved stays as the Delaunay split made
// it.
//
// Never moved: held vertices (Sheet::hold: pinned or loaded ones), corners, and vertices on older incisions; a vertex
// on the border moves only along a straight part of it. A tip is a vertex where it was asked for, however near to the
// border: the ligament is real, and no topology changes. The deformed position of a moved vertex is that of the same
// material point before (Sheet::move).
//
// Source: own. Related (none read): isosurface stuffing (Labelle and Shewchuk 2007) warps a lattice onto a surface
// where that is near and cuts it elsewhere; universal meshes (Rangarajan and Lew 2014) move the nodes of triangles
// along a curve onto it; CISAMR (Soghrati, Xiao and Nagarajan 2017) relocates the nodes of a structured grid and
// divides the rest; vertex_snap. Flips and moves that lower the worst aspect ratio: Freitag and Ollivier-Gooch 1997.
// Promises: area, conforming; the pieces that the exact path makes in the sheet as it is, whose older incisions lie
// within the tolerance of their curves. The incision error is at most the chord tolerance, since every step is checked
// against the requested curve (methods/tools/path_curve.h). Neither the exact path (its vertices lie on it, except
// beside sharp corners, but there are fewer) nor that vertices stay.
// Where it fails: an aspect ratio below 3 is sought within a budget, not guaranteed. It may be missed near forced
// wedges, between cuts that almost meet, and where the tolerance is large for the curve. Where an incision meets
// another, or the border at a small angle, slivers stay, with eigenvalues in the thousands. It costs three times a
// Delaunay split, seven times at a chord tolerance of 0.01 mean rest edges. Flips and moves change the deformed surface
// where the sheet is bent, and its bending energy, though by less than the slivers of a split without improvement.
#pragma once

#include "harness/cut/constraint_source.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class WarpAndRefine : public CuttingMethod, private ConstraintSource {
 public:
  /// The step before the split and the last step after it. A later step of After includes the earlier ones, except
  /// constraint (methods/tools/constrain_slivers.h), which does not change the mesh. The method is warp_and_thin with
  /// refine; the other combinations are rows of the ablation.
  enum class Before : std::uint8_t { nothing, snap, warp, thin, warp_and_thin };
  enum class After : std::uint8_t { nothing, flips, smoothing, refine, constraint };
  struct Options {
    Before before = Before::warp_and_thin;
    After after = After::refine;
    double thinness = 0.1;  ///< of slivers (After::constraint)
    double snap = 0.25;     ///< of an edge: crossings nearer to a vertex go through it (Before::snap)
    Warp::Options warping;
    Reshape::Options reshaping;
  };
  explicit WarpAndRefine(const Options& options)
      : options_(options), warp_(options.warping), reshape_(options.reshaping) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;
  const ConstraintSource* constraint_source() const override {
    return options_.after == After::constraint ? this : nullptr;
  }

 private:
  ConstraintKind constraint_kind() const override { return ConstraintKind::vertices; }
  Constraints constraints(const Sheet& before, const Sheet& cut) const override;

  Options options_;
  PathGraph path_;
  Warp warp_;
  PathCurve curve_;
  Reshape reshape_;
};

}  // namespace cutbench
