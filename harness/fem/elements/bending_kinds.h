// The kinds of bending, a row each. A new one is a header with a function that adds up the three rows of a triangle,
// next to bending_hinges.h, and a row at the end of the table in bending_kinds.cpp.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/enum_names.h"
#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/physics.h"
#include "harness/fem/elements/slope_patch.h"

namespace cutbench {

/// Side k of a triangle as the one on its other side has it; invalid on the border or an incision.
inline HalfEdge other_side(const Sheet& sheet, const std::map<HalfEdge, HalfEdge>& seams, TriangleIndex t,
                           std::size_t k) {
  const Triangle& triangle = sheet.triangle(t);
  if (triangle.opposite[k].valid()) return triangle.mark[k] == EdgeMark::incision ? HalfEdge() : triangle.opposite[k];
  if (seams.empty()) return {};
  const auto found = seams.find(half_edge(t, to_int(k)));
  return found == seams.end() ? HalfEdge() : found->second;
}

/// The three linear rows of one triangle under way, in sqrt(N/m): what each vertex near it counts in them. The energy
/// is half the sum of their squares. And what they are made from.
struct BendingStencil {
  const Sheet& sheet;
  double rigidity, poisson;                ///< D in N m
  const ElementTable* elements;            ///< null: each triangle is an element
  const GrowingRows<StencilTerm>& slopes;  ///< per triangle slot: SlopePatch::terms(), of a kind with slopes
  std::vector<std::int32_t>& place;        ///< per deformed vertex: in `terms`; -1: none
  std::vector<StencilTerm>& terms;
  const std::map<HalfEdge, HalfEdge>& seams;  ///< SeamEdges::across()

  /// The sums of this vertex, which begin at zero.
  std::array<double, 3>& at(std::int32_t vertex) {
    std::int32_t& mine = place[to_size(vertex)];
    if (mine < 0) {
      mine = to_int32(terms.size());
      terms.push_back({vertex, {}});
    }
    return terms[to_size(mine)].factor;
  }
  /// The triangles of the element that t belongs to.
  std::span<const TriangleIndex> members(const TriangleIndex& t) const { return members_of(elements, t); }
  /// Side k as the triangle on its other side has it, also over a seam; invalid on the border or an incision.
  HalfEdge across(TriangleIndex t, std::size_t k) const { return other_side(sheet, seams, t, k); }
  /// The triangle on the other side of side k; invalid where that is on the border, a seam or an incision.
  TriangleIndex neighbour(TriangleIndex t, std::size_t k) const {
    const Triangle& triangle = sheet.triangle(t);
    if (!triangle.opposite[k].valid() || triangle.mark[k] == EdgeMark::incision) return {};
    return triangle_of(triangle.opposite[k]);
  }
};

inline double twice_area(const std::array<Point2, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); }

struct BendingRow {
  const char* name;
  const char* help;
  void (*add_rows)(BendingStencil&, TriangleIndex);  ///< of an element, by its first triangle; null: no bending
  /// Slope patches are fitted (slope_patch.h), and the rows follow from them. Such a kind takes elements of several
  /// triangles; without, each triangle is one.
  bool has_slopes = false;
};
const BendingRow& row_of(BendingKind kind);
inline const char* name_of(BendingKind kind) { return row_of(kind).name; }
/// Of all kinds, for readers.
const std::vector<EnumName<BendingKind>>& bending_names();

}  // namespace cutbench
