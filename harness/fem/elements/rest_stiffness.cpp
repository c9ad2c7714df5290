#include "harness/fem/elements/rest_stiffness.h"

#include "harness/base/conversions.h"
#include "harness/fem/elements/element_stiffness.h"
#include "harness/fem/elements/polygon_sheet.h"

namespace cutbench {

namespace {

Vector2<double> gradient_vector(Point2 p) { return {p.x, p.y}; }

/// 2 k x 2 k, N/m.
Eigen::MatrixXd stiffness_of(const PolygonElement& polygon, const Lame& lame) {
  const auto k = to_index(polygon.size());
  StrainInFrame<2, double> at_rest{};
  at_rest.frame[0][0] = at_rest.frame[1][1] = 1;
  const ElementStiffness<2> stiffness({}, polygon.area, at_rest, {Strain::linear, StressStiffness::none, lame});
  const Eigen::MatrixXd stabilisation =
      stabilisation_of(lame, false).in_plane * polygon.departure.transpose() * polygon.departure;
  Eigen::MatrixXd matrix(2 * k, 2 * k);
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) {
      const auto block =
          stiffness.block(gradient_vector(polygon.gradient[to_size(i)]), gradient_vector(polygon.gradient[to_size(j)]));
      matrix.block<2, 2>(2 * i, 2 * j) =
          Eigen::Map<const Eigen::Matrix2d>(block.data()) + stabilisation(i, j) * Eigen::Matrix2d::Identity();
    }
  return matrix;
}

void add_polygon_force(const PolygonElement& polygon, const Eigen::MatrixXd& stiffness, const Field& moved,
                       Field& force) {
  Field at_corners(stiffness.rows());
  Eigen::Index next = 0;
  for (const auto d : polygon.polygon.corners) at_corners.segment<2>(2 * next++) = moved.segment<2>(2 * d.value);
  const Field pull = stiffness * at_corners;
  next = 0;
  for (const auto d : polygon.polygon.corners) force.segment<2>(2 * d.value) += pull.segment<2>(2 * next++);
}

}  // namespace

RestStiffness::RestStiffness(const ElementTable& elements, const Lame& lame) : elements_(elements), lame_(lame) {
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p)
    polygons_.push_back(stiffness_of(elements.polygon(p), lame));
}

void RestStiffness::add_force(const Field& moved, Field& force) const {
  for (const Element& element : elements_)
    if (element.is_triangle()) add_force(element, moved, force);
  for (std::size_t p = 0; p < polygons_.size(); ++p)
    add_polygon_force(elements_.polygon(p), polygons_[p], moved, force);
}

void RestStiffness::add_force(const Element& element, const Field& moved, Field& force) const {
  double xx = 0, yy = 0, xy = 0;  // strain
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [gx, gy] = element.gradient[k];
    const double u = moved[2 * element.vertex[k].value], v = moved[2 * element.vertex[k].value + 1];
    xx += u * gx;
    yy += v * gy;
    xy += (u * gy + v * gx) / 2;
  }
  const double pressure = lame_.lambda * (xx + yy), a = element.area;
  const double sx = a * (2 * lame_.mu * xx + pressure), sy = a * (2 * lame_.mu * yy + pressure);
  const double shear = a * 2 * lame_.mu * xy;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [gx, gy] = element.gradient[k];
    force[2 * element.vertex[k].value] += sx * gx + shear * gy;
    force[2 * element.vertex[k].value + 1] += shear * gx + sy * gy;
  }
}

}  // namespace cutbench
