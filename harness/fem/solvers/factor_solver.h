// Direct solution by a factor (harness/fem/linear/factor.h).
#pragma once

#include "harness/fem/linear/factor.h"
#include "harness/fem/linear/linear_solver.h"

namespace cutbench {

/// A matrix that is not positive definite is reported by solve(): not converged, x = 0.
template <int D>
class FactorSolver final : public LinearSolver<D> {
 public:
  explicit FactorSolver(std::unique_ptr<Factor<D>> factor) : factor_(std::move(factor)) {}
  void setup(const SystemMatrix<D>& a) override;
  SolveReport solve(const Field& b, Field& x, const Field& start) override;

 private:
  std::unique_ptr<Factor<D>> factor_;
  const SystemMatrix<D>* matrix_ = nullptr;
  bool factored_ = false;
  Field b_, r_;  ///< right-hand side, A x
  Eigen::MatrixXd right_, solution_;
};

}  // namespace cutbench
