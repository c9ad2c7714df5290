#include "harness/fem/tips/tip_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/tips/tip_quadrature.h"

namespace cutbench {

namespace {

/// Strain xx, yy, 2 xy of a displacement along axis a with this gradient.
Eigen::Vector3d strain(const Eigen::Vector2d& gradient, int axis) {
  if (axis == 0) return {gradient.x(), 0, gradient.y()};
  return {0, gradient.y(), gradient.x()};
}

Eigen::Matrix3d hooke(const Lame& lame) {
  Eigen::Matrix3d d;
  d << 2 * lame.mu + lame.lambda, lame.lambda, 0, lame.lambda, 2 * lame.mu + lame.lambda, 0, 0, 0, lame.mu;
  return d;
}

}  // namespace

TipSystem::TipSystem(const Sheet& sheet, const ElementTable& elements, const TipFunctions& functions,
                     const Lame& lame) {
  constexpr auto of_tip = to_index(2 * TipFunctions::per_tip);
  const auto unknowns = to_index(functions.unknowns());
  border_ = Eigen::MatrixXd::Zero(to_index(2 * sheet.deformed_slots()), unknowns);
  corner_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
  const Eigen::Matrix3d moduli = hooke(lame);
  std::vector<Point2> places;
  for (const TipFunctions::Tip& tip : functions.tips()) places.push_back(tip.at);
  using Strains = Eigen::Matrix<double, 3, of_tip>;  // a column for each unknown of a tip
  std::vector<Strains> here, integral;               // per tip that reaches the triangle
  for (std::size_t slot = 0; slot < sheet.triangle_slots(); ++slot) {
    const TriangleIndex t(slot);
    const auto reaching = functions.reaching(t);
    if (reaching.empty()) continue;
    const auto first = [&](std::size_t k) { return of_tip * to_index(reaching[k].tip); };
    double radius = std::numeric_limits<double>::infinity();
    for (const auto& reach : reaching) radius = std::min(radius, functions.tips()[reach.tip].radius);
    here.resize(reaching.size());
    integral.assign(reaching.size(), Strains::Zero());
    integrate_near_tips(sheet.corners(t), places, radius / 8, [&](Point2 p, double weight) {
      for (std::size_t k = 0; k < reaching.size(); ++k) {
        const auto values = functions.at(t, reaching[k], p);
        for (std::size_t j = 0; j < values.size(); ++j)
          for (int a = 0; a < 2; ++a) here[k].col(to_index(2 * j) + a) = strain(values[j].gradient, a);
        integral[k] += weight * here[k];
        const Strains stress = weight * moduli * here[k];
        for (std::size_t l = 0; l <= k; ++l)
          corner_.block<of_tip, of_tip>(first(l), first(k)).noalias() += here[l].transpose() * stress;
      }
    });
    const ElementShape shape = elements.shape(t);
    for (std::size_t corner = 0; corner < shape.corners.size(); ++corner) {
      const auto [gx, gy] = shape.gradient[corner];
      for (int a = 0; a < 2; ++a)
        for (std::size_t k = 0; k < reaching.size(); ++k)
          border_.block<1, of_tip>(2 * shape.corners[corner].value + a, first(k)) +=
              strain({gx, gy}, a).transpose() * moduli * integral[k];
    }
  }
  corner_.triangularView<Eigen::StrictlyLower>() = corner_.transpose();
}

double TipSystem::energy(const Field& u, const Eigen::VectorXd& c) const {
  return u.dot(border_ * c) + c.dot(corner_ * c) / 2;
}

SolveReport TipSystem::solve(LinearSolver<2>& solver, const Field& given, const Field& right, Field& u,
                             Eigen::VectorXd& c) const {
  SolveReport report = solver.solve(right, u);
  Eigen::MatrixXd moved(border_.rows(), border_.cols());  // K_uu^-1 K_uc
  Field column;
  for (Eigen::Index k = 0; k < border_.cols(); ++k) {
    const SolveReport other = solver.solve(border_.col(k), column);
    report.iterations += other.iterations;
    report.residual = std::max(report.residual, other.residual);
    report.converged = report.converged && other.converged;
    moved.col(k) = column;
  }
  const Eigen::LLT<Eigen::MatrixXd> schur(corner_ - border_.transpose() * moved);
  report.converged = report.converged && schur.info() == Eigen::Success;
  c = schur.solve(-border_.transpose() * (given + u));
  u -= moved * c;
  return report;
}

}  // namespace cutbench
