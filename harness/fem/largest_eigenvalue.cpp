#include "harness/fem/largest_eigenvalue.h"

#include <Eigen/Eigenvalues>
#include <random>
#include <vector>

#include "harness/fem/element_table.h"
#include "harness/fem/membrane.h"

namespace cutbench {

namespace {

using Eigen::VectorXd;

/// y = M^-1/2 K M^-1/2 x, element by element.
class ScaledStiffness {
 public:
  explicit ScaledStiffness(const Sheet& sheet) : lame_(lame_of({.stiffness = 1, .poisson = 0.3}, Plane::stress)) {
    std::vector<int> number(sheet.deformed_slots(), -1);
    std::vector<double> mass;
    for (const Element& element : ElementTable(sheet)) {
      if (!element.alive()) continue;
      Row& row = rows_.emplace_back();
      row.gradient = element.gradient, row.area = element.area;
      for (std::size_t k = 0; k < 3; ++k) {
        int& n = number[element.vertex[k]()];
        if (n < 0) n = static_cast<int>(mass.size()), mass.push_back(0);
        row.vertex[k] = n;
        mass[static_cast<std::size_t>(n)] += element.area / 3;
      }
    }
    scale_ = Eigen::Map<const VectorXd>(mass.data(), static_cast<Eigen::Index>(mass.size())).cwiseSqrt().cwiseInverse();
  }

  Eigen::Index size() const { return 2 * scale_.size(); }

  void apply(const VectorXd& x, VectorXd& y) const {
    y.setZero(size());
    for (const Row& row : rows_) {
      double xx = 0, yy = 0, xy = 0;  // strain
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [gx, gy] = row.gradient[k];
        const double s = scale_[row.vertex[k]], u = s * x[2 * row.vertex[k]], v = s * x[2 * row.vertex[k] + 1];
        xx += u * gx, yy += v * gy, xy += (u * gy + v * gx) / 2;
      }
      const double pressure = lame_.lambda * (xx + yy), a = row.area;
      const double sx = a * (2 * lame_.mu * xx + pressure), sy = a * (2 * lame_.mu * yy + pressure);
      const double shear = a * 2 * lame_.mu * xy;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [gx, gy] = row.gradient[k];
        const double s = scale_[row.vertex[k]];
        y[2 * row.vertex[k]] += s * (sx * gx + shear * gy), y[2 * row.vertex[k] + 1] += s * (shear * gx + sy * gy);
      }
    }
  }

 private:
  struct Row {
    std::array<int, 3> vertex;
    std::array<Point2, 3> gradient;
    double area;
  };
  Lame lame_;
  std::vector<Row> rows_;
  VectorXd scale_;  // M^-1/2, per vertex
};

}  // namespace

double largest_eigenvalue(const Sheet& sheet) {
  constexpr double tolerance = 1e-3;
  constexpr int most_steps = 1000, between_checks = 8;
  const ScaledStiffness stiffness(sheet);
  const Eigen::Index n = stiffness.size();
  if (n == 0) return 0;
  std::mt19937_64 bits(1);  // its bits, unlike the distributions, are the same everywhere
  VectorXd q(n), before = VectorXd::Zero(n), next;
  for (double& x : q) x = static_cast<double>(bits() >> 11) * 0x1p-53 - 0.5;
  q.normalize();
  // Without orthogonalisation: what that costs is copies of eigenvalues already found.
  std::vector<double> diagonal, beside;
  for (int step = 1;; ++step) {
    stiffness.apply(q, next);
    const double alpha = q.dot(next);
    next -= alpha * q;
    if (!beside.empty()) next -= beside.back() * before;
    const double beta = next.norm();
    diagonal.push_back(alpha);
    const bool exhausted = step == n || beta <= 1e-14 * std::abs(alpha) || step == most_steps;
    if (exhausted || step % between_checks == 0) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
      small.computeFromTridiagonal(Eigen::Map<VectorXd>(diagonal.data(), step),
                                   Eigen::Map<VectorXd>(beside.data(), step - 1));
      const double value = small.eigenvalues()[step - 1];
      if (exhausted || beta * std::abs(small.eigenvectors()(step - 1, step - 1)) <= tolerance * value) return value;
    }
    beside.push_back(beta);
    before.swap(q);
    q = next / beta;
  }
}

}  // namespace cutbench
