#include "harness/simulation/turned_over.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Eigen::Vector3d;

/// Half the cross product of two sides in space.
Vector3d area_vector(const ElementTable& elements, TriangleIndex t, const Field& x) {
  const Element& e = elements[t()];
  if (!e.is_triangle()) {
    const auto f = elements.linear_part<3>(t, x).gradient;
    return e.area * f.col(0).cross(f.col(1));
  }
  const auto at = [&](std::size_t k) { return Vector3d(x.segment<3>(3 * e.vertex[k].value)); };
  return (at(1) - at(0)).cross(at(2) - at(0)) / 2;
}

bool is_turned_in_plane(const ElementTable& elements, TriangleIndex t, const Field& x) {
  const Element& e = elements[t()];
  if (!e.is_triangle()) return elements.linear_part<2>(t, x).gradient.determinant() <= 0;
  const auto at = [&](std::size_t k) { return Point2{x[2 * e.vertex[k].value], x[2 * e.vertex[k].value + 1]}; };
  return orientation(at(0), at(1), at(2)) <= 0;
}

/// Longer or shorter than at rest, in some direction, by more than a quarter.
bool is_out_of_shape(const ElementTable& elements, TriangleIndex t, const Field& x) {
  const Element& e = elements[t()];
  Eigen::Matrix<double, 3, 2> f = Eigen::Matrix<double, 3, 2>::Zero();
  if (e.is_triangle()) {
    for (std::size_t k = 0; k < 3; ++k)
      f += x.segment<3>(3 * e.vertex[k].value) * Eigen::RowVector2d(e.gradient[k].x, e.gradient[k].y);
  } else {
    f = elements.linear_part<3>(t, x).gradient;
  }
  const Eigen::Matrix2d squares = f.transpose() * f;
  const double mean = squares.trace() / 2, least = mean - std::sqrt(std::max(0.0, mean * mean - squares.determinant()));
  return 2 * mean - least > 1.25 * 1.25 || least < 0.8 * 0.8;
}

bool is_turned_in_space(const Sheet& sheet, const ElementTable& elements, TriangleIndex t, const Field& x) {
  const Triangle& triangle = sheet.triangle(t);
  const Vector3d own = area_vector(elements, t, x);
  bool out_of_shape = is_out_of_shape(elements, t, x);
  int against = 0, along = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!triangle.opposite[k].valid() || triangle.mark[k] == EdgeMark::incision) continue;
    const TriangleIndex other = triangle_of(triangle.opposite[k]);
    const bool points_against = area_vector(elements, other, x).dot(own) < 0;
    ++(points_against ? against : along);
    out_of_shape |= points_against && is_out_of_shape(elements, other, x);
  }
  return against > 1 && against > along && out_of_shape;
}

}  // namespace

TurnedOver turned_over(const Sheet& sheet, const ElementTable& elements, const Field& x, int dimension) {
  TurnedOver found;
  double all = 0;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!elements[i].alive()) continue;
    all += elements[i].area;
    if (!(dimension == 2 ? is_turned_in_plane(elements, t, x) : is_turned_in_space(sheet, elements, t, x))) continue;
    ++found.triangles;
    found.area += elements[i].area;
  }
  if (all > 0) found.area /= all;
  return found;
}

}  // namespace cutbench
