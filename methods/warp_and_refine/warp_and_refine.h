// Warp and refine: the project's own method. The sheet gives way to the path before it is split, and what is still
// ill-shaped afterwards is mended.
//
// How it works. embed: vertices that the path passes within `reach` of an edge move to a point of the exact path
// (methods/tools/warp.h); every other crossing is split, with the Delaunay diagonal in each crossed triangle. improve
// (methods/tools/reshape.h), wherever the path has no forced wedge: thinning takes edges at the path shorter than 0.35
// mean rest edges out, where one end is a vertex of the path that it can do without, or one of the sheet beside it;
// then flips that make the worse of two triangles better, and moves of the corners of ill-shaped ones: those of the
// path slide along the curve as it was traced, never farther from that between two of them than the chord tolerance, or
// 0.05 mean rest edges, whichever is smaller (so from the curve itself by up to twice that); then, of what is left,
// edges are divided, and at last it is refined (methods/tools/delaunay_refinement.h). At a corner with an older
// incision, the border or itself the first edge of the path is turned, within the tolerance, where it leaves less room
// for a good triangle than the curve. Every single step is decided by exact predicates and leaves the path embedded, so
// that what can't be mended is left as the plain split made it.
//
// Never moved: held vertices (Sheet::hold: pinned or loaded ones), corners, those on older incisions; one on the border
// only along a straight part of it. A tip is a vertex where it was asked for, however near to the border: the ligament
// is real, and no topology changes. Moved vertices carry their deformed state over by the old map (Sheet::move).
//
// Source: own. Relatives: isosurface stuffing (Labelle and Shewchuk 2007) warps a lattice onto a surface where that is
// near and cuts it elsewhere; universal meshes (Rangarajan and Lew 2014) move the nodes of triangles along a curve onto
// it; CISAMR (Soghrati, Xiao and Nagarajan 2017) relocates the nodes of a structured grid and divides what is left;
// snapping by moves (vertex_snap). Flips and moves that lower the worst aspect ratio: Freitag and Ollivier-Gooch 1997.
// Promises: area, conforming; pieces as the exact path has them in the sheet as it is, whose older incisions lie within
// the tolerance of theirs. Neither the exact path (its vertices lie on it, but for those beside sharp corners, and
// there are fewer) nor that vertices stay. Fails: an aspect ratio below 3 is not guaranteed, only sought, within a
// budget; near forced wedges, between cuts that almost meet and where the tolerance is large for the curve it may be
// missed; and where an incision meets another, or the border at a small angle, slivers stay, with eigenvalues in the
// thousands. It costs three times a plain split, seven times at a chord tolerance of 0.01 mean rest edges. Flips and
// moves change the deformed surface where the sheet is bent, and its bending energy, though by less than the slivers of
// a plain split.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class WarpAndRefine : public CuttingMethod {
 public:
  /// What happens before the split, and how far the work after it goes: each step includes those before it, but tie
  /// (methods/tools/tie_slivers.h), which leaves the mesh as it is. The method is warp_and_thin with refine; the others
  /// are rows of the ablation.
  enum class Before : std::uint8_t { nothing, snap, warp, thin, warp_and_thin };
  enum class After : std::uint8_t { nothing, flips, smoothing, refine, tie };
  struct Options {
    Before before = Before::warp_and_thin;
    After after = After::refine;
    double thinness = 0.1;  ///< of slivers (After::tie)
    double snap = 0.25;     ///< of an edge: crossings nearer to a vertex go through it (Before::snap)
    Warp::Options warping;
    Reshape::Options reshaping;
  };
  explicit WarpAndRefine(const Options& options)
      : options_(options), warp_(options.warping), reshape_(options.reshaping) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;
  Tying tying() const override { return options_.after == After::tie ? Tying::vertices : Tying::nothing; }
  Ties ties(const Sheet& before, const Sheet& cut) const override;

 private:
  Options options_;
  PathGraph path_;
  Warp warp_;
  PathCurve curve_;
  Reshape reshape_;
};

}  // namespace cutbench
