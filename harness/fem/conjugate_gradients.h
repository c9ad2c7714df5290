// Conjugate gradients, preconditioned by the inverse diagonal blocks of the vertices or by larger ones round slivers
// (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 9.1).
#pragma once

#include <vector>

#include "harness/fem/linear_solver.h"
#include "harness/fem/sliver_blocks.h"

namespace cutbench {

template <int D>
class ConjugateGradients final : public LinearSolver<D> {
 public:
  ConjugateGradients(const SolverOptions& options, bool sliver_blocks)
      : options_(options), use_sliver_blocks_(sliver_blocks) {}
  void setup(const SystemMatrix<D>& a) override;
  SolveReport solve(const Field& b, Field& x) override;

 private:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Block = typename BlockMatrix<D>::Block;
  struct Products {
    double rr, rz;  ///< r.r and r.z
  };
  /// x += step p, r -= step A p, z = preconditioner r.
  Products advance(double step, Field& x);

  SolverOptions options_;
  bool use_sliver_blocks_;
  const SystemMatrix<D>* matrix_ = nullptr;
  std::vector<Block> inverse_;    ///< per vertex; zero where a sliver's block stands in
  bool positive_blocks_ = false;  ///< else A is not positive definite, which the iteration does not always notice
  SliverBlocks<D> sliver_blocks_;
  Field b_, r_, z_, p_, q_;  ///< right-hand side, residual, the same preconditioned, direction, A p
};

}  // namespace cutbench
