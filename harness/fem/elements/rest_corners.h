// Where the corners of a triangle are at rest, for its own metric: lengths, and nothing else.
#pragma once

#include <array>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// Places at rest in the plane of a triangle: those of the sheet's chart. Of a sheet that is its own rest shape
/// (Sheet::unrolled()): as they lie at rest in space (Sheet::position()). That differs where a method moved a vertex or
/// swapped an edge over a crease. Where the triangle would lose most of its area so, as over a sharp fold, the chart.
class RestPlane {
 public:
  RestPlane(const Sheet& sheet, TriangleIndex t);
  Point2 operator()(DeformedIndex d) const;

 private:
  const Sheet& sheet_;
  bool is_chart_ = true;
  Point3 origin_, x_, y_;
};

inline std::array<Point2, 3> rest_corners(const Sheet& sheet, TriangleIndex t) {
  if (!sheet.unrolled()) return sheet.corners(t);
  const RestPlane place(sheet, t);
  const auto& d = sheet.triangle(t).deformed;
  return {place(d[0]), place(d[1]), place(d[2])};
}

}  // namespace cutbench
