// The paper's method: Delaunay triangulation of each crossed triangle, then local split of the ill-shaped triangles,
// stopped after `rounds`. The paper repeats it until every aspect ratio is below 3 (4.1.3), which does not end: below.
//
// How it works. embed: the path's points are inserted into the crossed triangle one after the other by Bowyer-Watson:
// the triangles whose circumcircle holds the point are removed and the cavity is joined to the point. All changes stay
// inside the crossed triangle. With two crossings there is a single choice, the diagonal of one quadrilateral, and the
// path is always an edge. With points inside the triangle, or several passages, a path segment can be missing and is
// recovered by flips. improve: `rounds` times, each triangle that the cut made or changed and whose aspect ratio
// exceeds 3 gets its two longest edges split at their midpoints and is triangulated again by Bowyer-Watson inside
// itself; its neighbours across these edges are bisected at the same points. Edges shorter than twice `min_edge` are
// not split, and the split stops after `most_vertices` new vertices.
//
// Source: Xin et al. 2018, 4.1.2 and 4.1.3; Bowyer 1981; Watson 1981.
// Not as there: its points are those where the path crosses edges, and tips. That is a chord tolerance of infinity,
// which the paper's figures have here; comparisons add the points of curves inside triangles, as for all methods.
// Promises: the exact path, area, conforming, no vertex moved.
// Where it fails: the local split, read literally, cannot lower the largest aspect ratio. The circle through a corner A
// and the midpoints P, Q of the two long edges at A meets each of these edges only in A and its midpoint, so it holds
// no other point of the triangle: A P Q is always Delaunay, and it is the triangle itself at half the size. Each round
// leaves a copy of every ill-shaped triangle and bisects its neighbours, some of them into worse ones. The number of
// ill-shaped triangles grows by a factor of about 3.8 a round (experiments/local_split_rounds.toml).
#pragma once

#include "harness/cut/cutting_method.h"
#include "harness/cut/delaunay_split.h"

namespace cutbench {

class BowyerWatson : public CuttingMethod {
 public:
  struct Options {
    int rounds = 0;                       ///< of the local split; the registry's parameter, there 1 by default
    double max_aspect = 3;                ///< a triangle beyond it is ill-shaped
    double min_edge = 1e-6;               ///< no edge is made shorter than this, in mean rest edges
    std::size_t most_vertices = 200'000;  ///< made by one cut; then the local split stops where it is
  };
  explicit BowyerWatson(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  void split_long_edges(const Sheet& sheet, TriangleIndex t);

  Options options_;
  Subdivision midpoints_;
  std::vector<TriangleIndex> ill_shaped_;
};

/// Fills patch.triangles with a Delaunay triangulation of the patch's points; returns the number of segments recovered.
/// (In a crossing that comes down to is_diagonal_from_p_delaunay().)
int triangulate_delaunay(Patch& patch);

}  // namespace cutbench
