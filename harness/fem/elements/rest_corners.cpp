#include "harness/fem/elements/rest_corners.h"

#include "harness/base/products_in_space.h"

namespace cutbench {

namespace {

constexpr double most_lost = 0.5;  // share of its area in the chart

}  // namespace

std::array<Point2, 3> rest_corners(const Sheet& sheet, TriangleIndex t) {
  const std::array<Point2, 3> chart = sheet.corners(t);
  if (!sheet.unrolled()) return chart;
  const auto& d = sheet.triangle(t).deformed;
  const Point3 first = sheet.position(d[0]);
  const Point3 side = sheet.position(d[1]) + -1.0 * first, other = sheet.position(d[2]) + -1.0 * first;
  const double base = length(side), twice = length(cross(side, other));
  if (!(twice > (1 - most_lost) * cross(chart[1] - chart[0], chart[2] - chart[0]))) return chart;
  return {Point2{0, 0}, Point2{base, 0}, Point2{dot(side, other) / base, twice / base}};
}

}  // namespace cutbench
