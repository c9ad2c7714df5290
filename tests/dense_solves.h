// Dense problems, apart from the tests that solve them: Eigen's solvers take long to compile.
#pragma once

#include <Eigen/Core>

namespace cutbench {

/// Of the symmetric k, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k);

/// w² and v of k v = w² m v, ascending, v in columns. \pre k is symmetric, m positive definite
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Modes modes(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

/// Of all c q the one nearest to x.
Eigen::VectorXd nearest_in_range(const Eigen::MatrixXd& c, const Eigen::VectorXd& x);

/// The largest w² alone.
double largest_mode(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

}  // namespace cutbench
