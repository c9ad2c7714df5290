// Eigen's conjugate gradients, as users of Eigen call them.
#pragma once

#include <memory>

#include "harness/fem/linear/linear_solver.h"

namespace cutbench {

/// Eigen::ConjugateGradient with the inverse diagonal, or with an incomplete Cholesky factor in minimum degree order
/// (IncompleteCholesky: Lin and More, SIAM J. Sci. Comput. 21(1), 1999). Its residual is that of Eigen's recursion, so
/// it is called again, with a tolerance ten times smaller, until both of SolveReport's tests pass, at most five times.
/// Diagonal: a matrix that is not positive definite is noticed by its diagonal blocks only.
enum class EigenPreconditioner { diagonal, incomplete_cholesky };
template <int D>
std::unique_ptr<LinearSolver<D>> make_eigen_cg(const SolverOptions& options, EigenPreconditioner preconditioner);

}  // namespace cutbench
