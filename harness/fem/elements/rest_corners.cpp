#include "harness/fem/elements/rest_corners.h"

#include "harness/base/products_in_space.h"

namespace cutbench {

namespace {

constexpr double most_lost = 0.5;  // share of its area in the chart

}  // namespace

RestPlane::RestPlane(const Sheet& sheet, TriangleIndex t) : sheet_(sheet) {
  if (!sheet.unrolled()) return;
  const auto& d = sheet.triangle(t).deformed;
  const std::array<Point2, 3> chart = sheet.corners(t);
  origin_ = sheet.position(d[0]);
  const Point3 side = sheet.position(d[1]) + -1.0 * origin_, other = sheet.position(d[2]) + -1.0 * origin_;
  const Point3 normal = cross(side, other);
  if (!(length(normal) > (1 - most_lost) * cross(chart[1] - chart[0], chart[2] - chart[0]))) return;
  is_chart_ = false;
  x_ = (1 / length(side)) * side;
  const Point3 up = cross(normal, side);
  y_ = (1 / length(up)) * up;
}

Point2 RestPlane::operator()(DeformedIndex d) const {
  if (is_chart_) return sheet_.rest(sheet_.rest_vertex(d));
  const Point3 p = sheet_.position(d) + -1.0 * origin_;
  return {dot(x_, p), dot(y_, p)};
}

}  // namespace cutbench
