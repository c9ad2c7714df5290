// Where a method need not try: wedges between two incisions, or an incision and the border, that are too sharp for good
// triangles. For methods only; what a result is excused for is the audit's affair (harness/oracle/forced_zones.h).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "harness/mesh/one_ring.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Corners of the path with itself, older incisions and the border: calls visit(apex, right, left), neighbours of the
/// apex that its edges lead to, left counter-clockwise of right by less than asin(1/3) = 19.47 degrees, nothing between
/// them that separates. \pre the path is embedded and still closed.
template <class Visit>
void for_each_sharp_corner(const Sheet& sheet, Visit visit) {
  for (const VertexIndex apex : sheet.log().path_vertices) {
    if (!sheet.triangle_of_vertex(apex).valid()) continue;  // collapsed
    VertexIndex first, right;
    // From one separating outgoing edge to the next.
    const auto meet = [&](VertexIndex left) {
      if (right.valid()) {
        const Point2 a = sheet.rest(right) - sheet.rest(apex), b = sheet.rest(left) - sheet.rest(apex);
        const double sine = cross(a, b) / std::sqrt(squared_length(a) * squared_length(b));
        if (sine > 0 && sine < 1.0 / 3 && dot(a, b) > 0) visit(apex, right, left);
      }
      if (!first.valid()) first = left;
      right = left;
    };
    const HalfEdge start = sheet.first_outgoing(apex);
    HalfEdge h = start;
    for (;;) {
      if (sheet.separates(h)) meet(sheet.target(h));
      const HalfEdge next = sheet.next_outgoing(h);
      if (!next.valid()) meet(sheet.origin(Sheet::previous(h)));  // the border
      if (next == start && first.valid()) meet(first);
      if (!next.valid() || next == start) break;
      h = next;
    }
  }
}

/// The corners that the path makes with itself, older incisions and the border, at less than asin(1/3) = 19.47 degrees:
/// the triangle there has an aspect ratio above 3 whatever is done.
class ForcedWedges {
 public:
  ForcedWedges() = default;
  /// Holds only what lies well inside: `share` times the widths below. For a method that would rather try too much than
  /// leave alone what is not excused.
  explicit ForcedWedges(double share) : share_(share) {}
  /// Looks at the fans round the path's vertices. \pre the path is embedded and still closed.
  void find(const Sheet& sheet);
  bool empty() const { return corners_.empty(); }
  /// Whether p lies within `forced_wedge_disc` of a corner, or between its legs where they are closer than
  /// `forced_wedge_width` (mean rest edges; harness/mesh/tolerances.h). A leg ends where it turns by more than 45
  /// degrees, or once round.
  bool hold(Point2 p) const;
  bool hold(const std::array<Point2, 3>& triangle) const {
    return hold(1.0 / 3 * (triangle[0] + triangle[1] + triangle[2]));
  }

 private:
  struct Corner {
    Point2 apex, low, high;  // with the box round all that it holds
    std::size_t begin, end;  // of its wedge, in polygon_
  };
  void add(const Sheet& sheet, VertexIndex apex, VertexIndex right, VertexIndex left);

  std::vector<Corner> corners_;
  std::vector<Point2> polygon_, left_;
  double share_ = 1, disc_ = 0;
};

}  // namespace cutbench
