// Conjugate gradients (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 9.1).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "harness/fem/linear_solver.h"
#include "harness/fem/preconditioner.h"

namespace cutbench {

/// Convergence is judged alike for every preconditioner: by the residual, and by the residual in the norm of the inverse
/// diagonal blocks. The second is needed where |b| is all a sliver's huge forces: the rest of the sheet could be
/// anything.
template <int D>
class ConjugateGradients final : public LinearSolver<D> {
 public:
  /// \param preconditioner  null: the inverse diagonal blocks
  ConjugateGradients(const SolverOptions& options, std::unique_ptr<Preconditioner<D>> preconditioner)
      : options_(options), preconditioner_(std::move(preconditioner)) {}
  void setup(const SystemMatrix<D>& a) override;
  SolveReport solve(const Field& b, Field& x, const Field& start) override;

 private:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Block = typename BlockMatrix<D>::Block;
  struct Products {
    double rr = 0, rdr = 0;  ///< r.r, and r.D^-1 r with the diagonal blocks D
    double rz = 0;           ///< r.z, z being the preconditioned residual
  };
  /// x += step p, r -= step A p, z = D^-1 r.
  Products advance(double step, Field& x);
  /// z = preconditioned r.
  void precondition(Products& now);

  SolverOptions options_;
  std::unique_ptr<Preconditioner<D>> preconditioner_;
  bool preconditions_ = false;  ///< of the solve at hand: by preconditioner_
  const SystemMatrix<D>* matrix_ = nullptr;
  std::vector<Block> inverse_;    ///< per vertex
  bool positive_blocks_ = false;  ///< else A is not positive definite, which the iteration does not always notice
  Field b_, r_, z_, p_, q_;       ///< right-hand side, residual, the same preconditioned, direction, A p
};

}  // namespace cutbench
