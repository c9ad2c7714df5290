#include "harness/cut/forced_wedges.h"

#include <cmath>
#include <optional>

namespace cutbench {

void ForcedWedges::find(const Sheet& sheet) {
  corners_.clear();
  disc_ = share_ * 0.25 * sheet.mean_edge();
  const double width = share_ * 0.3 * sheet.mean_edge();
  for (const VertexIndex v : sheet.log().path_vertices) {
    if (!sheet.triangle_of_vertex(v).valid()) continue;  // collapsed
    const Point2 apex = sheet.rest(v);
    std::optional<Point2> first;
    Point2 right;
    // From one separating spoke to the next: nothing lies between them.
    const auto meet = [&](Point2 left) {
      const double sine = cross(right, left);
      if (first && sine > 0 && sine < 1.0 / 3 && dot(right, left) > 0)
        corners_.push_back({apex, right, left, width / std::sqrt(squared_length(left - right))});
      if (!first) first = left;
      right = left;
    };
    const auto towards = [&](VertexIndex end) {
      const Point2 edge = sheet.rest(end) - apex;
      return 1 / std::sqrt(squared_length(edge)) * edge;
    };
    const HalfEdge start = sheet.first_spoke(v);
    HalfEdge h = start;
    for (;;) {
      if (sheet.separates(h)) meet(towards(sheet.target(h)));
      const HalfEdge next = sheet.turn_left(h);
      if (!next.valid()) meet(towards(sheet.origin(Sheet::previous(h))));  // the border
      if (next == start && first) meet(*first);
      if (!next.valid() || next == start) break;
      h = next;
    }
  }
}

bool ForcedWedges::hold(Point2 p) const {
  for (const Corner& corner : corners_) {
    const Point2 from = p - corner.apex;
    const double distance2 = squared_length(from);
    if (distance2 < disc_ * disc_) return true;
    if (distance2 < corner.reach * corner.reach && cross(corner.right, from) > 0 && cross(from, corner.left) > 0)
      return true;
  }
  return false;
}

}  // namespace cutbench
