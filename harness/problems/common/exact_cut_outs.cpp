// The exact fields round what was cut out of a plate: a corner, an ellipse.
#include <cmath>

#include "harness/problems/common/potentials.h"

namespace cutbench {

double Corner::exponent() const {
  const double angle = 2 * half_angle, sign = sliding ? -1 : 1;
  double low = 0.5, high = 1 - 1e-6;  // 1 itself solves the equation of sliding: a rotation
  for (int step = 0; step < 60; ++step) {
    const double q = (low + high) / 2;
    (std::sin(q * angle) + sign * q * std::sin(angle) > 0 ? low : high) = q;
  }
  return low;
}

ElasticField corner_field(const Elastic& elastic, const Axes& frame, const Corner& corner, double stress) {
  const double q = corner.exponent(), angle = 2 * corner.half_angle, sign = corner.sliding ? -1 : 1;
  const double b = -sign * (std::cos(q * angle) + sign * q * std::cos(angle));
  const double ahead = q * (corner.sliding ? q - 1 + b : q + 1 + b);  // of A = 1, or i
  const Complex scale = stress / ahead * (corner.sliding ? Complex(0, 1) : Complex(1, 0));
  return {elastic, frame, [=](Complex z) {
            const Complex power = scale * std::pow(z, q), power_1 = q * power / z;
            return Potentials{power, power_1, (q - 1) * power_1 / z, b * power, b * power_1};
          }};
}

Complex Ellipse::to_circle(Complex z) const {
  const double focus = std::sqrt(a * a - b * b);
  return (z + std::sqrt(z - focus) * std::sqrt(z + focus)) / (2 * mean());
}

ElasticField elliptic_hole_field(const Elastic& elastic, const Axes& frame, const Ellipse& ellipse,
                                 const PlaneStress& far_away) {
  const double mean = (far_away.xx + far_away.yy) / 4, r = ellipse.mean(), m = ellipse.ratio();
  const Complex d((far_away.yy - far_away.xx) / 2, far_away.xy), c = std::conj(d);
  const auto outside = [=](Complex t) {
    const Complex w = 1.0 / t, from_pole = 1.0 / (t * t - m);
    // By t, in units of R: dz/dt = 1 - m / t^2.
    const Complex z_1 = 1.0 - m * w * w, z_2 = 2 * m * w * w * w;
    const Complex phi_1 = mean + (c + mean * m) * w * w, phi_2 = -2.0 * (c + mean * m) * w * w * w;
    const Complex hoop = (1.0 + m * t * t) * w * from_pole, all_round = 2 * mean * (1 + m * m) * t * from_pole;
    const Complex hoop_1 = 2 * m * from_pole - hoop * (w + 2.0 * t * from_pole);
    const Complex all_round_1 = all_round * (w - 2.0 * t * from_pole);
    return Potentials{r * (mean * t - (c + mean * m) * w), phi_1 / z_1, (phi_2 - phi_1 * z_2 / z_1) / (z_1 * z_1 * r),
                      r * (d * t - c * hoop - all_round), (d - c * hoop_1 - all_round_1) / z_1};
  };
  const auto solution = [=](Complex z) {
    const Complex t = ellipse.to_circle(z);
    if (std::abs(t) >= 1) return outside(t);
    const Complex on_circle = t / std::abs(t), off = std::conj(ellipse.from_circle(on_circle) - z);
    Potentials rim = outside(on_circle);  // the formulas of stress and displacement take z itself
    rim.psi += off * rim.phi_1;
    rim.psi_1 += off * rim.phi_2;
    return rim;
  };
  return {elastic, frame, solution};
}

}  // namespace cutbench
