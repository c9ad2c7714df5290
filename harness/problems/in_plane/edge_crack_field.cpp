#include "harness/problems/in_plane/edge_crack_field.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/problems/common/potentials.h"

namespace cutbench {

namespace {

constexpr double strip_half_height = edge_crack_height / 2.0;

struct ValueAndDerivatives {
  Complex f, f_1, f_2;
};

/// What p and q are made of, at z. The constant comes first.
class RealFunctions {
 public:
  static constexpr int degree = 36, poles = 24, powers = 6;

  explicit RealFunctions(double depth) : depth_(depth) {
    for (int k = 1; k <= poles; ++k) from_mouth_.push_back(std::exp(-2.2 * (std::sqrt(poles) - std::sqrt(k))));
  }

  std::vector<ValueAndDerivatives> at(Complex z) const {
    std::vector<ValueAndDerivatives> values{{1, 0, 0}};
    append_polynomials(z, values);
    for (const double d : from_mouth_) {
      const Complex r = 1.0 / (z + depth_ + d);
      values.push_back({d * r, -d * r * r, 2 * d * r * r * r});
    }
    const double middle = 2 - 1.5 * depth_, near = 1 - depth_ / 2;  // of the mirror image; its distance from the side
    const Complex r = 1.0 / (z - middle);
    Complex power = 1;
    for (int k = 1; k <= powers; ++k) {
      power *= near * r;
      const double n = k;
      values.push_back({power, -n * power * r, n * (n + 1) * power * r * r});
    }
    return values;
  }

 private:
  /// i^n T_n(-i w), which is real where w is.
  void append_polynomials(Complex z, std::vector<ValueAndDerivatives>& values) const {
    constexpr double scale = 1 / strip_half_height;
    const Complex w = scale * (z - 0.5 + depth_);
    values.push_back({w, scale, 0});
    for (int n = 1; n < degree; ++n) {
      const ValueAndDerivatives last = values[to_size(n - 1)], here = values[to_size(n)];
      values.push_back({2.0 * w * here.f + last.f, 2.0 * (scale * here.f + w * here.f_1) + last.f_1,
                        2.0 * (2.0 * scale * here.f_1 + w * here.f_2) + last.f_2});
    }
  }

  double depth_;
  std::vector<double> from_mouth_;  // poles
};

Potentials of_p(Complex z, const ValueAndDerivatives& p) {
  const Complex root = std::sqrt(z);
  return collinear_potentials(z, 1, root * p.f, p.f / (2.0 * root) + root * p.f_1,
                              (p.f_1 - p.f / (4.0 * z)) / root + root * p.f_2);
}

Potentials of_q(Complex z, const ValueAndDerivatives& q) {
  const Complex i(0, 1);
  return collinear_potentials(z, i, -i * q.f, -i * q.f_1, -i * q.f_2);
}

/// Places on the upper half of the border, and what the tractions must be. Below it is the same by symmetry.
class Collocation {
 public:
  static constexpr int places = 50;  ///< on a side, and as many more at the mouth

  explicit Collocation(double depth) : functions_(depth) {
    const std::size_t of_each = functions_.at(1).size();
    const Eigen::Index rows = 8 * places, columns = to_index(2 * of_each - 1);
    tractions_.resize(rows, columns);
    wanted_ = Eigen::VectorXd::Zero(rows);
    for (int i = 0; i < places; ++i) {
      const double even = (1 - std::cos(std::numbers::pi * (i + 0.5) / places)) / 2;  // crowded towards both ends
      const double crowded = std::pow(10, -6 + 5.5 * i / (places - 1));               // at the mouth
      add({-depth, strip_half_height * even}, false);
      add({-depth, strip_half_height * crowded}, false);
      add({1 - depth, strip_half_height * even}, false);
      add({even - depth, strip_half_height}, true);
    }
  }

  /// Of p, then of q, whose constant is a rigid motion and is left out; under a unit stress.
  Eigen::VectorXd coefficients() const {
    const Eigen::VectorXd scale = tractions_.colwise().norm().transpose().cwiseInverse();
    return scale.cwiseProduct((tractions_ * scale.asDiagonal()).householderQr().solve(wanted_));
  }

  const RealFunctions& functions() const { return functions_; }

 private:
  void add(Complex z, bool end) {
    const auto set = [&](Eigen::Index column, const Potentials& f) {
      const double mean = 2 * f.phi_1.real();
      const Complex deviator = std::conj(z) * f.phi_2 + f.psi_1;
      tractions_(row_, column) = end ? mean + deviator.real() : mean - deviator.real();
      tractions_(row_ + 1, column) = deviator.imag();
    };
    const std::vector<ValueAndDerivatives> values = functions_.at(z);
    const Eigen::Index of_each = to_index(values.size());
    for (Eigen::Index k = 0; k < of_each; ++k) set(k, of_p(z, values[to_size(k)]));
    for (Eigen::Index k = 1; k < of_each; ++k) set(of_each + k - 1, of_q(z, values[to_size(k)]));
    wanted_[row_] = end ? 1 : 0;
    row_ += 2;
  }

  RealFunctions functions_;
  Eigen::MatrixXd tractions_;
  Eigen::VectorXd wanted_;
  Eigen::Index row_ = 0;
};

}  // namespace

ElasticField edge_crack_field(const Elastic& elastic, const Axes& frame, double depth, double stress) {
  const Collocation collocation(depth);
  const Eigen::VectorXd c = stress * collocation.coefficients();
  const auto solution = [c, functions = collocation.functions()](Complex z) {
    const std::vector<ValueAndDerivatives> values = functions.at(z);
    ValueAndDerivatives p{}, q{};
    const auto add = [](ValueAndDerivatives& sum, double factor, const ValueAndDerivatives& value) {
      sum.f += factor * value.f;
      sum.f_1 += factor * value.f_1;
      sum.f_2 += factor * value.f_2;
    };
    for (std::size_t k = 0; k < values.size(); ++k) add(p, c[to_index(k)], values[k]);
    for (std::size_t k = 1; k < values.size(); ++k) add(q, c[to_index(values.size() + k - 1)], values[k]);
    return of_p(z, p) + of_q(z, q);
  };
  return {elastic, frame, solution, beside_the_axis};
}

}  // namespace cutbench
