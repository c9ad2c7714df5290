#include "harness/fem/elements/rest_stiffness.h"

namespace cutbench {

RestStiffness::RestStiffness(const ElementTable& elements, const Lame& lame)
    : elements_(elements), lame_(lame), compounds_(elements, lame) {}

void RestStiffness::add_force(const Field& moved, Field& force) const {
  for (const Element& element : elements_)
    if (element.is_triangle()) add_force(element, moved, force);
  compounds_.add_force(elements_, moved, force);
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
