#include "harness/scene/turned_over.h"

#include <Eigen/Geometry>

#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Eigen::Vector3d;

/// Half the cross product of two sides in space.
Vector3d area_vector(const Triangle& t, const Field& x) {
  const auto at = [&](std::size_t k) { return Vector3d(x.segment<3>(3 * t.deformed[k].value)); };
  return (at(1) - at(0)).cross(at(2) - at(0)) / 2;
}

bool is_turned_in_plane(const Triangle& t, const Field& x) {
  const auto at = [&](std::size_t k) { return Point2{x[2 * t.deformed[k].value], x[2 * t.deformed[k].value + 1]}; };
  return orientation(at(0), at(1), at(2)) <= 0;
}

bool is_turned_in_space(const Sheet& sheet, const Triangle& t, const Field& x) {
  Vector3d around = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    if (t.opposite[k].valid() && t.mark[k] != EdgeMark::incision)
      around += area_vector(sheet.triangle(triangle_of(t.opposite[k])), x);
  return around.dot(area_vector(t, x)) < 0;
}

}  // namespace

TurnedOver turned_over(const Sheet& sheet, const Field& x, int dimension) {
  TurnedOver found;
  double all = 0;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const Triangle& t = sheet.triangle(TriangleIndex(i));
    if (!t.alive()) continue;
    const auto [a, b, c] = sheet.corners(TriangleIndex(i));
    const double area = cross(b - a, c - a) / 2;
    all += area;
    if (!(dimension == 2 ? is_turned_in_plane(t, x) : is_turned_in_space(sheet, t, x))) continue;
    ++found.triangles, found.area += area;
  }
  if (all > 0) found.area /= all;
  return found;
}

}  // namespace cutbench
