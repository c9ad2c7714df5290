// Conjugate gradients (Saad, Iterative Methods for Sparse Linear Systems, 2003, algorithm 9.1).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/linear/preconditioner.h"

namespace cutbench {

/// Convergence is judged alike for every preconditioner: by the residual, and by the residual in the norm of the
/// inverse diagonal blocks. The second is needed where |b| is all a sliver's huge forces: the rest of the sheet could
/// be anything.
///
/// Preconditioners are tried in order; the diagonal blocks, which cannot fail, come last. One that was not positive
/// definite, or took too many iterations, is left out until the next set-up, and for twice as many set-ups each time it
/// fails again at once: where a sheet is cut to pieces, no cut makes it worth a trial. What follows is set up when it
/// is first needed.
template <int D>
class ConjugateGradients final : public LinearSolver<D> {
 public:
  struct Trial {
    std::unique_ptr<Preconditioner<D>> preconditioner;
    int most_iterations = 1000;  ///< of a solve; more show that rounding or the sheet has spoilt it
    bool is_set_up = false;      ///< with the matrix at hand
  };
  /// \param workers  must outlive this
  ConjugateGradients(const SolverOptions& options, std::vector<Trial> trials, Workers& workers = Workers::none())
      : options_(options), workers_(&workers), trials_(std::move(trials)) {}
  void setup(const SystemMatrix<D>& a) override;
  SolveReport solve(const Field& b, Field& x, const Field& start) override;

 private:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Block = typename BlockMatrix<D>::Block;
  struct Products {
    double rr = 0, rdr = 0;  ///< r.r, and r.D^-1 r with the diagonal blocks D
    double rz = 0;           ///< r.z, z being the preconditioned residual
    Products& operator+=(const Products& with) {
      rr += with.rr;
      rdr += with.rdr;
      rz += with.rz;
      return *this;
    }
  };
  /// x += step p, r -= step A p, z = D^-1 r.
  Products advance(double step, Field& x);
  /// z = preconditioned r.
  void precondition(Products& now);
  /// Sets up the preconditioner at trial_, if there is one.
  void prepare();
  void give_up();

  double dot(const Field& a, const Field& b) const;

  SolverOptions options_;
  Workers* workers_;
  std::vector<Trial> trials_;
  std::size_t trial_ = 0;      ///< the one in use; past the end: the diagonal blocks
  std::size_t first_ = 0;      ///< the one that solves begin with
  int pause_ = first_pause;    ///< set-ups without those before first_, next time one fails
  int until_first_again_ = 0;  ///< set-ups
  static constexpr int first_pause = 1, longest_pause = 4096;
  const SystemMatrix<D>* matrix_ = nullptr;
  std::vector<Block> diagonals_;  ///< per vertex; none without a preconditioner
  std::vector<Block> inverse_;    ///< of these
  bool positive_blocks_ = false;  ///< else A is not positive definite, which the iteration does not always notice
  Field b_, r_, z_, p_, q_;       ///< right-hand side, residual, the same preconditioned, direction, A p
};

}  // namespace cutbench
