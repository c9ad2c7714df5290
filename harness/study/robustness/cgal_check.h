// The cross-check: a cut as a careful user of CGAL makes it who has no cutting method, by triangulating the whole sheet
// anew.
//
// It stands beside the methods where results are judged, so it shares no code with them: nothing of harness/mesh or
// harness/cut.
#pragma once

#include <string>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

struct CrossCheckResult {
  Mesh mesh;             ///< where refused: the input
  bool refused = false;  ///< CGAL threw an exception
  std::string reason;    ///< of the refusal, in one line
  /// Farthest that CGAL laid a constraint (border, older incision or path) from the segment it was given, rest units.
  double moved = 0;
};

/// Cuts by a constrained Delaunay triangulation of all of `before`: CGAL::Constrained_triangulation_plus_2, kernel
/// Epick, intersections under Exact_predicates_tag, as CGAL's manual suggests for double coordinates. The input's
/// vertices are its points; border, older incisions and the flattened path, in this order, its constraints. Triangles
/// outside the border are dropped, and what is left is opened along all constraints. A slit of a single edge, whose
/// tips could not part, gets a vertex in its middle.
///
/// Promises
/// - input vertex i keeps its index and the bits of its rest point; where several have bit-equal rest points (lips),
///   which of them a fan of triangles gets is arbitrary;
/// - the input comes back unchanged where the path has no length or opens nothing: wholly outside, along the border or
///   along older incisions.
/// Does not promise
/// - the input's triangles: all change, so a chain of cuts does not keep the graded or structured look of a sheet;
/// - the path: CGAL merges what it can't tell apart in doubles, and moves constraints for it, without a word; an input
///   vertex or a triangle may then fall outside the border. Let the oracle judge; `moved` tells how far;
/// - snapping of any kind, nor quality: points a few ulps apart become edges of a few ulps;
/// - an end: CGAL's recursion over intersections is not bounded. Isolate a robustness run from its stack and from its
/// time.
///
/// Bezier curves are flattened to `flatten_tolerance` (rest units, > 0). Time about n log n of the whole sheet.
/// Precondition: what judge() asks of an input. Throws what flatten() throws.
CrossCheckResult cgal_whole_sheet_cut(const Mesh& before, const Curve& curve, double flatten_tolerance);

}  // namespace cutbench::oracle
