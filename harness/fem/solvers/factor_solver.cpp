#include "harness/fem/solvers/factor_solver.h"

#include "harness/fem/linear/direct_solve.h"

namespace cutbench {

template <int D>
void FactorSolver<D>::setup(const SystemMatrix<D>& a) {
  matrix_ = &a;
  factored_ = factor_->factor(a);
}

template <int D>
SolveReport FactorSolver<D>::solve(const Field& b, Field& x, const Field& /*start*/) {
  project(*matrix_->held, b, b_);
  x.setZero(b.size());
  const double norm = b_.norm();
  SolveReport report;
  const bool nothing = b_.isZero(0);
  report.residual = nothing ? 0 : 1;  // of x = 0
  if (!factored_) return report;
  // No iterative refinement: on slivers, where the residual is not at rounding level, it gains a factor of 1.5.
  if (!nothing) {
    right_ = b_;
    if (!factor_->solve(right_, solution_)) return report;
    x = solution_;
    matrix_->multiply(x, r_);
    report.residual = (b_ - r_).norm() / norm;
  }
  report.converged = is_direct_solution(report.residual, norm, factor_->largest_entry(), x.norm());
  return report;
}

template class FactorSolver<2>;
template class FactorSolver<3>;

}  // namespace cutbench
