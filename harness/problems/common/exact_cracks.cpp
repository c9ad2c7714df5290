// The exact fields of several cuts, and of cuts whose lips are loaded.
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/problems/common/potentials.h"

namespace cutbench {

namespace {

using std::numbers::pi;

/// z -> sqrt(z^2 - c^2), like z far away; it jumps between -c and c.
Complex root_of_both(Complex z, Complex c) { return std::sqrt(z - c) * std::sqrt(z + c); }

/// The factors of the pressures U_0, U_2, U_4, ... that make crossing lips of length 2 free under a unit stress.
class CrossedLips {
 public:
  CrossedLips() {
    constexpr Eigen::Index terms = 80;
    Eigen::MatrixXd on_lip(terms, terms);
    for (Eigen::Index i = 0; i < terms; ++i) {
      const double angle = (to_double(i) + 0.5) / terms * pi / 2, x = std::cos(angle);
      const double root = std::sqrt(1 + x * x), w = root - x;
      double power = w, sign = -1;
      for (Eigen::Index k = 0; k < terms; ++k) {
        const double n = to_double(2 * k + 1);
        // s_xx = g' + y dg'/dy of the other cut, on the line through its middle.
        const double across = sign * power / root * (1 - x * n / root - x * x / (root * root));
        on_lip(i, k) = std::sin(n * angle) / std::sin(angle) - across;
        power *= w * w;
        sign = -sign;
      }
    }
    factors_ = on_lip.partialPivLu().solve(Eigen::VectorXd::Ones(terms));
  }

  /// K1 / sqrt(pi)
  double intensity() const { return factors_.sum(); }

  /// Of the cut along the x axis.
  Potentials along_x(Complex z) const {
    const Complex root = root_of_both(z, 1), w = z - root;
    Complex power = w, g = 0, g_1 = 0, g_2 = 0;
    for (Eigen::Index k = 0; k < factors_.size(); ++k) {
      const double n = to_double(2 * k + 1);
      const Complex term = factors_[k] * power;
      g -= term / n;
      g_1 += term / root;
      g_2 -= term * (n + z / root) / (root * root);
      power *= w * w;
    }
    return collinear_potentials(z, 0.5, g, g_1, g_2);
  }

  /// Of the cut along the y axis: turned by a right angle.
  Potentials along_y(Complex z) const {
    const Complex i(0, 1);
    const Potentials f = along_x(-i * z);
    return {i * f.phi, f.phi_1, -i * f.phi_2, -i * f.psi, -f.psi_1};
  }

 private:
  Eigen::VectorXd factors_;
};

const CrossedLips& crossed_lips() {
  static const CrossedLips lips;
  return lips;
}

}  // namespace

ElasticField collinear_cracks_field(const Elastic& elastic, const Axes& frame, double a, double period,
                                    const PlaneStress& far_away) {
  const double p = pi / period, end = std::sin(p * a);
  const auto solution = [=](Complex z) {
    const double turns = std::round(z.real() / period);
    const Complex here = z - turns * period;
    const Complex s = std::sin(p * here), c = std::cos(p * here), root = root_of_both(s, end);
    const Complex g = -Complex(0, 1) / p * std::log((c + Complex(0, 1) * root) / std::cos(p * a));
    const Complex g_2 = -p * end * end * c / (root * root * root);
    return uniform_potentials(far_away, z) +
           collinear_potentials(z, Complex(far_away.yy, -far_away.xy) / 2.0, g - here, s / root - 1.0, g_2);
  };
  return {elastic, frame, solution, beside_the_axis};
}

Eigen::Vector2d LipLoad::above(double x, double a) const {
  if (std::abs(x) > a) return {0, 0};
  return {shear.even + shear.odd * x / a, normal.even + normal.odd * x / a};
}

ElasticField loaded_crack_field(const Elastic& elastic, const Axes& frame, double a, const LipLoad& load) {
  const Complex even(load.normal.even, -load.shear.even), odd(load.normal.odd, -load.shear.odd);
  const auto solution = [=](Complex z) {
    const Complex root = root_of_both(z, a), cube = root * root * root;
    return collinear_potentials(z, even / 2.0, root - z, z / root - 1.0, -a * a / cube) +
           collinear_potentials(z, odd / 2.0, z * (root - z) / (2 * a), (2.0 * z * z - a * a) / (2 * a * root) - z / a,
                                z * (2.0 * z * z - 3 * a * a) / (2 * a * cube) - 1 / a);
  };
  return {elastic, frame, solution, beside_the_axis};
}

ElasticField crossed_cracks_field(const Elastic& elastic, const Axes& frame, double a, double stress) {
  const auto solution = [=, &lips = crossed_lips()](Complex z) {
    const Potentials f = lips.along_x(z / a) + lips.along_y(z / a);
    return uniform_potentials({stress, stress, 0}, z) +
           Potentials{stress * a * f.phi, stress * f.phi_1, stress / a * f.phi_2, stress * a * f.psi, stress * f.psi_1};
  };
  const auto on_side = [](Complex z, Complex side) {
    const Complex turn(0, 1);
    return turn * beside_the_axis(-turn * beside_the_axis(z, side), -turn * side);
  };
  return {elastic, frame, solution, on_side};
}

double crossed_cracks_factor() { return crossed_lips().intensity(); }

}  // namespace cutbench
