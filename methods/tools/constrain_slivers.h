// Constrains the vertices of slivers: each is extrapolated from a master triangle, a good triangle on its own side of
// the cut.
//
// L is the longest edge of the triangles round a triangle's corners. A length is short where it is below `thinness`
// times L; a triangle with a short altitude is a sliver. The rules:
//  - Vertices of the sheet before its first cut stay free, also those on its border and on both lips.
//  - Of the vertices that cuts made, one is constrained (a) where an edge path to a free vertex is short. Candidates
//    are taken in turns: tips first, then by their smallest altitude, the largest first. Of the rest, one is
//    constrained (b) where it is a short distance from the opposite edge of a triangle, the shortest first, unless a
//    corner of that triangle was constrained for this reason. A constrained vertex counts as lying at the nearest free
//    vertex, its stand-in.
//  - The master triangle is no sliver when constrained corners are replaced by their stand-ins. It has the vertex's
//    stand-in for a corner and, where one triangle has them all, the stand-ins of the other stiff corners of the
//    vertex's thinnest triangle. Of several, the one is taken in which the vertex lies farthest inside, or least
//    outside (by its smallest barycentric coordinate). The search stays on the vertex's side, among triangles with a
//    corner nearer than L. Masters are free, so there are no chains of constraints. In a sheet that is its own rest
//    shape the triangle lies in a plane with the vertex (methods/tools/creases.h).
//  - No constraint reaches across the cut. Both lips share a tip; a tip is constrained to the nearest edge or vertex,
//    and so are vertices of the lips that are a short distance from a tip. Each fan at a junction or a crossing is a
//    side of its own, and so is each lip at the border.
//  - Where there is no such triangle (a piece, or a strip between cuts, that has slivers only), the vertex stays free,
//    and as stiff as it was.
//  - A vertex that is held on an axis (a pin, a border displacement) is not constrained on that axis. Loads on
//    constrained vertices go to their masters.
//
// Source: aggregated finite elements (Badia, Verdugo and Martin, The aggregated unfitted finite element method for
// elliptic problems, CMAME 336, 2018), where whole cut cells are extrapolated from a good one.
#pragma once

#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// \param before  the sheet before its first cut: its vertices are never constrained.
/// \param thinness  of a sliver: altitude over L, >= 0; 0 constrains nothing
/// \param only_divided  `cut` was divided, but not changed otherwise. Then the cost is that of the neighbourhood of
///                      the cuts, else it looks at all vertices, too (new_triangles()).
Constraints constrain_slivers(const Sheet& before, const Sheet& cut, double thinness, bool only_divided);

/// All constraints after one more cut, that of the log of `cut`, which was only divided. Those of `last` stay where the
/// cut changed no triangle within their reach, and no master of theirs. So the order in which slivers are looked at may
/// differ from that of constrain_slivers() where cuts are near each other, and with it the choice; the rules hold all
/// the same.
/// \param last  the constraints before that cut, of this function or of constrain_slivers()
Constraints constrain_new_slivers(const Sheet& before, const Sheet& cut, double thinness, const Constraints& last);

}  // namespace cutbench
