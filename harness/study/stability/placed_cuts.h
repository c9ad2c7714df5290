// Cuts that come near something: each passes one vertex, edge, border or older incision at a given distance, and keeps
// clear of everything else, so that a sweep over the distance shows what the distance does.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// The names that placed_cut() knows beside those of cut_families(); `place` is a distance in mean rest edges h unless
/// said otherwise:
/// - `past_vertex`: a straight cut, 2 to 5 h long, that passes a vertex at this distance.
/// - `along_edge`: one parallel to an edge at this distance, past both of its ends.
/// - `along_border`: in from the sheet, along the border at this distance for 2 to 4 h, and back.
/// - `tip_at_edge`: one whose tip stops at this distance before the middle of an edge.
/// - `recut`: a cut 4 h long, and another across its middle; `place` is the angle between them in degrees.
/// - `strip`: two parallel cuts 3 h long at this distance.
/// - `piece`: cut out, round a triangle, with its shape; `place` is its size: 1 is the triangle itself.
/// - `in_a_row`: as many small cuts (make_small_cut) in one sheet as `place` says.
std::span<const char* const> placed_cuts();

/// Case i: one or more curves, to be cut one after the other. Depends on the name, the place, the seed, i and the sheet
/// alone; cases that differ in their place alone are at the same spot. The spot is the one of `tried` random ones whose
/// cuts stay farthest from all other vertices, and their tips from all edges. For a name of cut_families(): its case i.
/// Throws InputError for an unknown name.
std::vector<Curve> placed_cut(const std::string& name, double place, std::uint64_t seed, std::size_t i,
                              const Sheet& sheet);

}  // namespace cutbench
