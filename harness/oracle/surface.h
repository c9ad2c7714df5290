// How many pieces a sheet is in that is sewn together, or curved at rest and unrolled, judged on the surface itself.
//
// Its panels lie apart in the plane, each with the lengths that it has on the surface. So every triangle of the old
// sheet, cut by the path, is the same in the plane as on the surface, and the exact arrangement of border and path says
// what parts there are; parts that lie along a seam opposite each other are one.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// A sheet before a cut.
struct Surface {
  Mesh mesh;
  std::vector<int> point;  ///< per vertex: those with equal numbers are one point of the surface
  /// The two sides of each, from the same end; none: edges of the border between the same points.
  std::vector<std::array<Segment, 2>> seams = {};
};

struct SurfaceJudgement {
  int pieces = 0;           ///< of the result: triangles connected through shared edges, and over seams
  int expected = 0;         ///< of the path, without pieces thinner than `tip`
  int least = 0, most = 0;  ///< where it hangs on less than a ten thousandth of a seam's length
  int crossings = 0;        ///< ends of curves on a seam from where another curve goes on at the other side
  int alone = 0;            ///< ends of curves on a seam, but not at an end of it, where none does
  int unopened = 0;         ///< crossings where the result's border goes on uncut
};

/// \param cuts   in the plane; a path over a seam is a curve for each panel, which ends where the next one begins
/// \param after  each border edge of it lies on one of `before`, or on a lip
/// \param tip    a curve that ends nearer than this to a seam ends on it; rest units
/// \pre both are manifolds of counter-clockwise triangles with indices in range
SurfaceJudgement judge_surface(const Surface& before, const std::vector<Curve>& cuts, const Mesh& after, double tip);

}  // namespace cutbench::oracle
