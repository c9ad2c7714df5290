#include "tests/dense_solves.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace cutbench {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
}

Modes modes(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(k, m);
  return {solved.eigenvalues(), solved.eigenvectors()};
}

double largest_mode(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(k, m, Eigen::EigenvaluesOnly);
  return solved.eigenvalues().tail(1)[0];
}

Eigen::VectorXd nearest_in_range(const Eigen::MatrixXd& c, const Eigen::VectorXd& x) {
  return c * c.completeOrthogonalDecomposition().solve(x);
}

}  // namespace cutbench
