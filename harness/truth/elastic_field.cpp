#include "harness/truth/elastic_field.h"

#include <cmath>
#include <numbers>

namespace cutbench {

namespace {

using std::numbers::pi;
// What counts as on the cut, in units of the sheet: far above rounding, far below everything else.
constexpr double on_the_cut = 1e-9;

Eigen::Vector2d vector(Complex z) { return {z.real(), z.imag()}; }

/// A point on the x axis, moved to the side of it where `side` is by less than anything else can feel.
Complex beside_the_axis(Complex z, Complex side) {
  return std::abs(z.imag()) < on_the_cut ? Complex(z.real(), std::copysign(1e-300, side.imag())) : z;
}

}  // namespace

Eigen::Matrix2d Elastic::stress(const Eigen::Matrix2d& strain) const {
  return young / (1 - poisson * poisson) *
         ((1 - poisson) * strain + poisson * strain.trace() * Eigen::Matrix2d::Identity());
}

Eigen::Matrix2d Elastic::strain(const Eigen::Matrix2d& stress) const {
  return ((1 + poisson) * stress - poisson * stress.trace() * Eigen::Matrix2d::Identity()) / young;
}

Complex Axes::to_local(Point2 p) const { return Complex(p.x - origin.x, p.y - origin.y) * std::polar(1.0, -angle); }

Point2 Axes::to_rest(Complex z) const {
  const Complex p = z * std::polar(1.0, angle);
  return {origin.x + p.real(), origin.y + p.imag()};
}

ElasticField::ElasticField(const Elastic& elastic, const Axes& frame)
    : elastic_(elastic), frame_(frame), axis_(std::polar(1.0, frame.angle)) {
  rotation_ << axis_.real(), -axis_.imag(), axis_.imag(), axis_.real();
}

Complex ElasticField::to_local(Point2 p) const {
  return Complex(p.x - frame_.origin.x, p.y - frame_.origin.y) * std::conj(axis_);
}

ElasticField::State ElasticField::state(Point2 p, Point2 side) const {
  const Complex z = to_local(p);
  const Potentials f = potentials(on_side(z, to_local(side)));
  const double kappa = elastic_.kappa(), half = 1 / (2 * elastic_.mu());
  const Complex even = kappa * f.phi_1 - std::conj(f.phi_1), odd = z * std::conj(f.phi_2) + std::conj(f.psi_1);
  Eigen::Matrix2d gradient;
  gradient << vector(even - odd), vector(Complex(0, 1) * (even + odd));
  State state;
  state.displacement = half * (rotation_ * vector(kappa * f.phi - z * std::conj(f.phi_1) - std::conj(f.psi)));
  state.gradient = half * (rotation_ * gradient * rotation_.transpose());
  state.stress = elastic_.stress((state.gradient + state.gradient.transpose()) / 2);
  return state;
}

ElasticField::Potentials UniformField::potentials(Complex z) const {
  const double mean = (xx_ + yy_) / 4;
  const Complex deviator((yy_ - xx_) / 2, xy_);
  return {mean * z, mean, 0, deviator * z, deviator};
}

namespace {

/// Of the fields with phi = k g, psi = conj(k) g - z phi', where g is real on the x axis ahead of the cut: what crosses
/// the axis there is s_yy - i s_xy = 2 k g', and nothing crosses it where g' is imaginary.
struct Collinear {
  Complex phi, phi_1, phi_2, psi, psi_1;
  Collinear(Complex z, Complex k, Complex g, Complex g_1, Complex g_2)
      : phi(k * g),
        phi_1(k * g_1),
        phi_2(k * g_2),
        psi(std::conj(k) * g - z * phi_1),
        psi_1(std::conj(k) * g_1 - phi_1 - z * phi_2) {}
};

}  // namespace

ElasticField::Potentials WilliamsField::potentials(Complex z) const {
  const Complex root = std::sqrt(z);
  const Collinear f(z, Complex(k1_, -k2_) / std::sqrt(2 * pi), root, 0.5 / root, -0.25 / (root * z));
  return {f.phi, f.phi_1, f.phi_2, f.psi, f.psi_1};
}

Complex WilliamsField::on_side(Complex z, Complex side) const { return beside_the_axis(z, side); }

ElasticField::Potentials StraightCrackField::potentials(Complex z) const {
  const Complex root = std::sqrt(z - a_) * std::sqrt(z + a_);  // the jumps beyond -a cancel
  const Collinear f(z, Complex(yy_, -xy_) / 2.0, root - z, z / root - 1.0, -a_ * a_ / (root * root * root));
  const double mean = (xx_ + yy_) / 4;
  const Complex deviator((yy_ - xx_) / 2, xy_);
  return {f.phi + mean * z, f.phi_1 + mean, f.phi_2, f.psi + deviator * z, f.psi_1 + deviator};
}

Complex StraightCrackField::on_side(Complex z, Complex side) const { return beside_the_axis(z, side); }

ArcCrackField::ArcCrackField(const Elastic& elastic, const Axes& frame, double radius, double half_angle, double stress)
    : ElasticField(elastic, frame),
      radius_(radius),
      half_angle_(half_angle),
      c_(stress / (1 + std::pow(std::sin(half_angle / 2), 2))),
      d_(stress - c_),
      end_(std::polar(1.0, half_angle)),
      turn_(std::polar(1.0, half_angle / 2)) {}

Complex ArcCrackField::root(Complex z) const {
  // The branch that is z at infinity and jumps on the arc: (z - a) / (z - b), of its ends, maps the arc to a ray.
  const Complex to_other = z - std::conj(end_);
  return to_other * turn_ * std::sqrt((z - end_) / (to_other * end_));
}

ElasticField::Potentials ArcCrackField::potentials(Complex z) const {
  z /= radius_;
  const double middle = end_.real();
  const Complex x = root(z), slope = (z - middle) / x, inverse = 1.0 / z;
  const Complex phi = (c_ * x + d_ * z) / 2.0, phi_1 = (c_ * slope + d_) / 2.0;
  const Complex phi_2 = c_ * (1.0 - slope * slope) / x / 2.0;
  // omega and its derivative at 1 / conj z, conjugated: X is real on the real axis. A reflected point is on the other
  // side of the arc.
  const Complex reflected = std::conj(root(1.0 / std::conj(z)));
  const Complex omega = (c_ * reflected - d_ * inverse) / 2.0;
  const Complex omega_1 = (c_ * (inverse - middle) / reflected - d_) / 2.0;
  return {radius_ * phi, phi_1, phi_2 / radius_, radius_ * (omega - phi_1 * inverse),
          (phi_1 - z * phi_2 - omega_1) * inverse * inverse};
}

Complex ArcCrackField::on_side(Complex z, Complex side) const {
  const double off = std::abs(z) / radius_ - 1;
  if (std::abs(off) >= on_the_cut || std::abs(std::arg(z)) > half_angle_) return z;
  return std::polar(radius_ * (1 + std::copysign(on_the_cut, std::abs(side) - radius_)), std::arg(z));
}

ElasticField::Potentials HoleField::potentials(Complex z) const {
  const Complex q = radius_ * radius_ / (z * z);
  const double s = stress_;
  return {s / 4 * z * (1.0 + 2.0 * q), s / 4 * (1.0 - 2.0 * q), s * q / z, -s / 2 * z * (1.0 + q - q * q),
          -s / 2 * (1.0 - q + 3.0 * q * q)};
}

}  // namespace cutbench
