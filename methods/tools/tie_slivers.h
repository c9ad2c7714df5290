// Which vertices of a cut sheet are better no unknowns: those of slivers, each of which goes where the linear field of
// a good triangle on its own side of the cut has it.
//
// With L the longest edge of the triangles round a triangle's corners, a length is short where it is below `thinness`
// L, and a triangle with a short altitude is a sliver. The rules:
//  - Vertices of the sheet before its first cut are free, those on its border and on both lips too.
//  - Of those that cuts made, each is tied (a) where a free vertex is a short way off, along edges: they are taken in
//    turns, tips first, then by the smallest of their altitudes, the largest first. Of what is left, each is tied (b)
//    where it is a short way off the opposite edge of a triangle, shortest first, unless a corner there was tied for
//    its sake. Tied vertices count as being where the nearest free one is, which stands for them.
//  - A tied vertex follows a triangle that is no sliver when what is tied is drawn to what stands for it, and that has
//    its own stand-in for a corner, and those of the other stiff corners of its thinnest triangle if one has all: of
//    these the one that it is farthest inside of, or least outside (by its smallest barycentric coordinate). Looked for
//    on its own side, by way of triangles with a corner nearer than L. Masters are free, so there are no chains.
//  - So no tie reaches across the cut. Both lips share a tip; where a tip is tied, it is to the nearest edge or vertex,
//    and so are vertices of the lips that are a short way off a tip. A fan of a junction or of a crossing is a side of
//    its own, and so is each lip at the border.
//  - Where there is no such triangle (a piece, or a strip between cuts, that consists of slivers only), the vertex
//    stays free, and as stiff as it was.
//  - What is held (a pin, a border displacement) is not tied on that axis; loads on tied vertices go to their masters.
//
// Source: aggregated finite elements (Badia, Verdugo and Martin, The aggregated unfitted finite element method for
// elliptic problems, CMAME 336, 2018), where whole cut cells follow a good one.
#pragma once

#include "harness/mesh/sheet.h"
#include "harness/mesh/ties.h"

namespace cutbench {

/// Looks at everything. \param before  the sheet before its first cut: its vertices are never tied.
/// \param thinness  of a sliver: altitude over L, >= 0; 0 ties nothing
Ties tie_slivers(const Sheet& before, const Sheet& cut, double thinness);

}  // namespace cutbench
