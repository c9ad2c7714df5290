#include "harness/problems/common/exact_fields.h"

#include <cmath>
#include <numbers>

#include "harness/problems/common/potentials.h"

namespace cutbench {

namespace {

using std::numbers::pi;
/// The potentials of an arc of radius 1.
class Arc {
 public:
  Arc(double half_angle, const PlaneStress& far_away)
      : half_angle_(half_angle),
        middle_(std::cos(half_angle)),
        end_(std::polar(1.0, half_angle)),
        turn_(std::polar(1.0, half_angle / 2)),
        g_((far_away.yy - far_away.xx) / 2, -far_away.xy) {
    const double mean = (far_away.xx + far_away.yy) / 4, sine_2 = 1 - middle_ * middle_;
    c_ = Complex((4 * mean + g_.real() * sine_2 / 2) / (3 - middle_), -g_.imag() * sine_2 / (2 * (1 + middle_)));
    d_ = 2 * mean - c_;
  }

  Potentials operator()(Complex z) const {
    const Complex x = root(z), slope = (z - middle_) / x, w = 1.0 / z;
    // d/dz of -X / z, which is without a residue at 0, and of that again.
    const Complex odd = (w - middle_) * w / x, odd_1 = (middle_ - 2.0 * w) * w * w / x - odd * slope / x;
    const Complex phi = (c_ * x + d_ * z - g_ * (x + 1.0) * w) / 2.0;
    const Complex phi_1 = (c_ * slope + d_ + g_ * (odd + w * w)) / 2.0;
    const Complex phi_2 = (c_ * (1.0 - slope * slope) / x + g_ * (odd_1 - 2.0 * w * w * w)) / 2.0;
    // omega and its derivative at 1 / conj z, conjugated: X is real on the real axis. A reflected point is on the other
    // side of the arc.
    const Complex y = std::conj(root(1.0 / std::conj(z))), c = std::conj(c_), d = std::conj(d_), g = std::conj(g_);
    const Complex omega = (c * y - d * w - g * (y - 1.0) * z) / 2.0;
    const Complex omega_1 = (c * (w - middle_) / y - d + g * ((z - middle_) * z / y - z * z)) / 2.0;
    return {phi, phi_1, phi_2, omega - phi_1 * w, (phi_1 - z * phi_2 - omega_1) * w * w};
  }

  Complex on_side(Complex z, Complex side) const {
    if (std::abs(std::abs(z) - 1) >= on_the_cut || std::abs(std::arg(z)) > half_angle_) return z;
    return std::polar(1 + std::copysign(on_the_cut, std::abs(side) - 1), std::arg(z));
  }

 private:
  /// X: the branch that is z at infinity and jumps on the arc. (z - a) / (z - b), of its ends, maps the arc to a ray.
  Complex root(Complex z) const {
    const Complex to_other = z - std::conj(end_);
    return to_other * turn_ * std::sqrt((z - end_) / (to_other * end_));
  }

  double half_angle_, middle_;
  Complex end_, turn_;  // exp(i A), exp(i A / 2)
  Complex g_, c_, d_;
};

}  // namespace

ElasticField uniform_field(const Elastic& elastic, const Axes& frame, const PlaneStress& stress) {
  return {elastic, frame, [=](Complex z) { return uniform_potentials(stress, z); }};
}

ElasticField williams_field(const Elastic& elastic, const Axes& frame, const StressIntensity& k) {
  const Complex factor = Complex(k.k1, -k.k2) / std::sqrt(2 * pi);
  const auto solution = [=](Complex z) {
    const Complex root = std::sqrt(z);
    return collinear_potentials(z, factor, root, 0.5 / root, -0.25 / (root * z));
  };
  return {elastic, frame, solution, beside_the_axis};
}

ElasticField straight_crack_field(const Elastic& elastic, const Axes& frame, double a, const PlaneStress& far_away) {
  const auto solution = [=](Complex z) {
    const Complex root = std::sqrt(z - a) * std::sqrt(z + a);  // the jumps beyond -a cancel
    const Potentials whole = uniform_potentials(far_away, z),
                     cut = collinear_potentials(z, Complex(far_away.yy, -far_away.xy) / 2.0, root - z, z / root - 1.0,
                                                -a * a / (root * root * root));
    return Potentials{cut.phi + whole.phi, cut.phi_1 + whole.phi_1, cut.phi_2, cut.psi + whole.psi,
                      cut.psi_1 + whole.psi_1};
  };
  return {elastic, frame, solution, beside_the_axis};
}

ElasticField arc_crack_field(const Elastic& elastic, const Axes& frame, double radius, double half_angle,
                             const PlaneStress& far_away) {
  const Arc arc(half_angle, far_away);
  const auto solution = [=](Complex z) {
    const Potentials f = arc(z / radius);
    return Potentials{radius * f.phi, f.phi_1, f.phi_2 / radius, radius * f.psi, f.psi_1};
  };
  return {elastic, frame, solution,
          [=](Complex z, Complex side) { return radius * arc.on_side(z / radius, side / radius); }};
}

StressIntensity arc_intensity_all_round(double radius, double half_angle, double stress) {
  const double c = std::cos(half_angle / 2), s = std::sin(half_angle / 2);
  const double scale = stress * std::sqrt(pi * radius * std::sin(half_angle)) / (1 + s * s);
  return {scale * c, scale * s};
}

StressIntensity arc_intensity_along_axis(double radius, double half_angle, double stress) {
  const double c = std::cos(half_angle / 2), s = std::sin(half_angle / 2), p = s * s, q = p * c * c;
  const double scale = stress / 2 * std::sqrt(pi * radius * std::sin(half_angle));
  return {scale * ((1 - q) * c / (1 + p) + std::cos(1.5 * half_angle)),
          scale * ((1 - q) * s / (1 + p) + std::sin(1.5 * half_angle))};
}

ElasticField hole_field(const Elastic& elastic, const Axes& frame, double radius, double stress) {
  return {elastic, frame, [=](Complex z) {
            const Complex q = radius * radius / (z * z);
            const double s = stress;
            return Potentials{s / 4 * z * (1.0 + 2.0 * q), s / 4 * (1.0 - 2.0 * q), s * q / z,
                              -s / 2 * z * (1.0 + q - q * q), -s / 2 * (1.0 - q + 3.0 * q * q)};
          }};
}

}  // namespace cutbench
