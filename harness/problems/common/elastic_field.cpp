#include "harness/problems/common/elastic_field.h"

#include <cmath>
#include <utility>

namespace cutbench {

namespace {

Eigen::Vector2d vector(Complex z) { return {z.real(), z.imag()}; }

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

ElasticField::ElasticField(const Elastic& elastic, const Axes& frame, Solution potentials, OnSide on_side)
    : elastic_(elastic),
      frame_(frame),
      axis_(std::polar(1.0, frame.angle)),
      potentials_(std::move(potentials)),
      on_side_(std::move(on_side)) {
  rotation_ << axis_.real(), -axis_.imag(), axis_.imag(), axis_.real();
}

Complex ElasticField::to_local(Point2 p) const {
  return Complex(p.x - frame_.origin.x, p.y - frame_.origin.y) * std::conj(axis_);
}

ElasticField::State ElasticField::state(Point2 p, Point2 side) const {
  const Complex z = to_local(p);
  const Potentials f = potentials_(on_side_ ? on_side_(z, to_local(side)) : z);
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

}  // namespace cutbench
