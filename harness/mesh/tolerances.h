// Every tolerance of cutting, with its reason. Decisions on the mesh are exact (predicates.h); a tolerance only says
// when a path is taken for one that goes through a vertex or has a point on an edge.
//
// The unit is the snap distance of the sheet, Sheet::snap(). In these words:
//   through a vertex  A straight piece of the path that passes a vertex within `line_tolerance` goes through it. A
//                     corner, tip or crossing of the path (a point) within `point_tolerance` of a vertex is that
//                     vertex.
//   on an edge        A point of the path within `line_tolerance` of an edge lies on it. A piece with both ends on one
//                     edge runs along it.
// The distance of a point from a line is measured along the axis to which the line is steeper: 1 to 1.41 times the
// shortest distance. So a piece within 1.41 snap distances of a vertex always goes through it, beyond 2 never.
// The oracle (harness/oracle) shares no code with this: it is told the distances in its request
// (harness/judge/oracle_request.cpp).
#pragma once

#include <algorithm>

namespace cutbench {

/// The snap distance, rest units. It lies far above the rounding of an intersection to doubles (some ulp) and far below
/// anything that a user draws. \param size  diagonal of the sheet's bounding box \param ulp  of its largest coordinate
inline double snap_distance(double size, double ulp) { return std::max(1e-12 * size, 8 * ulp); }

// --- in snap distances -----------------------------------------------------------------------------------------------

/// Two points nearer than this are one point.
constexpr double point_tolerance = 1;
/// A point nearer than this to a line lies on it. Twice the tolerance of points: every crossing that is left is clear
/// of the ends of its edge, and its rounded position can't fall behind them.
constexpr double line_tolerance = 2;
/// Two points that were each moved by up to `line_tolerance` are this near: a path shorter than this has no length, and
/// two paths that meet may each be off by half of it.
constexpr double meeting_tolerance = 2 * line_tolerance;
/// Nearer than this to where a straight piece begins, its direction says nothing; the exact predicates decide.
constexpr double direction_tolerance = 8;
/// Two lines nearer than this may cross several times by rounding, and enclose pieces that are not there.
constexpr double coincidence_tolerance = 16;
/// The rounding of a crossing: what lies nearer to an edge than this lies on it exactly.
constexpr double rounding_tolerance = 0.5;
/// How far a border vertex may move the border sideways when it slides along it: nothing that a cut could see.
constexpr double straight_border_tolerance = 1e-3;

// --- in sizes of the sheet -------------------------------------------------------------------------------------------

/// A path may reach this far. Beyond it, the rounding of a point of the path is as large as the snap distance.
constexpr double longest_path_reach = 1000;

// --- in mean rest edges (h) ------------------------------------------------------------------------------------------

/// A Bezier is flattened this closely, for tracing: a fiftieth of the default chord tolerance.
constexpr double default_flatten_tolerance = 1e-3;
/// Points of a curve inside a triangle become vertices where a chord would be farther from the curve than this.
constexpr double default_chord_tolerance = 0.05;
/// Careful embedding may move a crossing this far out of a wedge that is too thin for doubles; the cut is then
/// `deviated`.
constexpr double careful_move_tolerance = 1e-4;
/// Refinement divides no piece of path, incision or border shorter than twice this: two borders that nearly coincide
/// would be divided for ever.
constexpr double shortest_refined_edge = 1e-4;
/// A forced wedge is the area between its legs while they are nearer than this, and a disc of this radius round its
/// apex (docs/explanation/measuring.md): closer, not even one good triangle fits between. The oracle has the same
/// numbers of its own.
constexpr double forced_wedge_width = 0.3;
constexpr double forced_wedge_disc = 0.25;

}  // namespace cutbench
