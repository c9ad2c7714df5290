// Where a method need not try: wedges between two incisions, or an incision and the border, that are too sharp for good
// triangles. For methods only; what a result is excused for is the audit's affair (harness/measure/forced_zones.h).
#pragma once

#include <array>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

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
  /// Does p lie within 0.25 mean rest edges of a corner, or between its legs where they are closer than 0.3? A leg ends
  /// where it turns by more than 45 degrees, or once round.
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
