// Merges the thin triangles that cuts made with their neighbours into polygons, each of which can be one element.
//
// The thickness of a triangle or polygon is 4 area / perimeter; one that a cut made is thin below `thinness` times the
// thickness of the triangle before the first cut of which it is a part (of a polygon: of the thinnest of these). The
// largest eigenvalue of an element goes like 1 / thickness^2. The rules:
//  - The thinnest first, in relation, until none is thin or can be merged: it joins the neighbour across its longest
//    edge that no cut separates, and that is no crease at rest. That may be a triangle that no cut met.
//  - Where the result would have a hole, meet a vertex twice, hold a vertex inside that something is attached to
//    (Sheet::is_held()), or be thicker than the thin one by less than a tenth, the neighbour across the next longest
//    edge is taken. Where there is none, it stays thin until a neighbour has grown: at last strips between two cuts,
//    and pieces smaller than a triangle.
//  - Where every vertex is to stay an unknown, a polygon that would have one inside counts as no polygon, too.
//  - A polygon never reaches across an incision, but it may reach round a tip; the incision is then a slit in it.
//
// Source: the merging of cut cells in CutVEM (Rangarajan and Sukumar, arXiv 2508.10570, 2025; abstract read);
// there a cell is merged for the ratio of the extreme eigenvalues of its matrix, and no unknown is lost.
#pragma once

#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

struct ThinParts {
  double thinness = 0.7;      ///< >= 0; 0 merges nothing
  bool all_unknowns = false;  ///< no vertex comes to lie inside a polygon
};

/// In the order of their first triangles. Depends on the neighbourhood of the cuts alone, and so does its cost: of all
/// cuts together, each time.
/// \param before  the sheet before its first cut
std::vector<Polygon> merge_thin_parts(const Sheet& before, const Sheet& cut, const ThinParts& rules);

/// The same for the parts that the cut of the log of `cut` made, what it freed, and what is thin beside them. What they
/// join may be a polygon that was there before. Its cost grows with this cut, not with earlier ones.
/// \return the polygons that are new
std::vector<Polygon> merge_new_thin_parts(const Sheet& before, const Sheet& cut, const ThinParts& rules,
                                          const PolygonsLeft& left);

}  // namespace cutbench
