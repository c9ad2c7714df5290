// Seeded cuts for tests and experiments.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// Where a sheet lies and how fine it is: the generators scale their cuts by it.
struct SheetExtent {
  Point2 low, high;      ///< rest bounding box
  double mean_edge = 0;  ///< of the sheet as constructed
};
SheetExtent extent_of(const Sheet& sheet);

/// The names make_case knows; all lengths in sides of the rest bounding box (S) or mean rest edges (h):
/// - `straight`: a line right across the sheet, its ends on the border or outside.
/// - `curved`: a Bezier from side to side, inside in between, radius of curvature at least 0.05 S, not crossing itself.
/// - `partial`: such a Bezier with both tips inside.
/// - `border_inward`: a Bezier from the border or outside to a tip inside.
/// - `cut_out`: a smooth closed Bezier chain, 0.06 to 0.25 S in radius; one in four leaves the sheet.
/// - `recut`: a curved cut from left to right and one from bottom to top.
/// - `several`: four cuts of the kinds above.
/// - `self_crossing`: a Bezier loop, a pentagram or a figure eight, in turns.
/// - `tiny_loop`, `tiny_open`: wholly inside one triangle.
/// - `u_turn`: hairpins, pointed, blunt or round, that turn inside a triangle or 1e-9 (round ones: 0.01) to 0.3 h
///   behind an edge.
/// - `through_vertices`: polylines and Beziers with ends and corners at vertices, and lines through two vertices.
/// - `along_edges`: polylines along chains of edges, along the border too, some ending inside an edge or leaving it.
std::span<const char* const> cut_families();

/// Case i of a family: one or more curves, to be cut one after the other. Depends on seed, family, i and the sheet's
/// extent alone, and for `tiny_*`, `u_turn`, `through_vertices` and `along_edges` on the sheet's triangles. Throws
/// InputError for an unknown family, listing the known ones.
std::vector<Curve> make_case(const std::string& family, std::uint64_t seed, std::size_t i, const Sheet& sheet);

/// Cut i of many that are made one after the other in one sheet, as in surgery: of the kinds of `several`, or crossing
/// itself, but only 0.1 to 0.3 S long or wide, anywhere, across the border too. Depends on seed, i and the
/// sheet's extent alone.
Curve make_small_cut(std::uint64_t seed, std::size_t i, const Sheet& sheet);

}  // namespace cutbench
