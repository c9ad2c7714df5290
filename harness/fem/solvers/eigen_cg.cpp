#include "harness/fem/solvers/eigen_cg.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>

#include "harness/base/conversions.h"
#include "harness/fem/linear/compressed_columns.h"

namespace cutbench {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr int most_rounds = 5;

template <int D, class Method>
class EigenIterative final : public LinearSolver<D> {
 public:
  explicit EigenIterative(const SolverOptions& options) : options_(options) {}

  void setup(const SystemMatrix<D>& a) override {
    matrix_ = &a;
    columns_.set_pattern(a);
    columns_.set_values(a);
    usable_ = columns_.all_finite();
    for (std::size_t i = 0; usable_ && i < a.vertices(); ++i) {
      const auto block = a.diagonal(i);
      usable_ = block(0, 0) > 0 && block.determinant() > 0;
    }
    if (!usable_) return;
    // Its products are the fastest of Eigen's.
    full_ = columns_.lower_triangle().template selfadjointView<Eigen::Lower>();
    method_.compute(full_);
    usable_ = method_.info() == Eigen::Success;
  }

  SolveReport solve(const Field& b, Field& x, const Field& start) override {
    project(*matrix_->held, b, b_);
    x.setZero(b.size());
    SolveReport report;
    if (b_.isZero(0)) {
      report.converged = true;
      return report;
    }
    report.residual = 1;
    if (!usable_ || !b_.allFinite()) return report;
    if (start.size() == b.size()) project(*matrix_->held, start, x);
    const double norm = b_.norm(), equilibrated = equilibrated_norm(b_);
    double tolerance = options_.tolerance;
    for (int round = 0; round < most_rounds && !report.converged; ++round, tolerance /= 10) {
      method_.setTolerance(tolerance);
      method_.setMaxIterations(options_.max_iterations - report.iterations);
      const Field next = method_.solveWithGuess(b_, x);
      if (!next.allFinite()) return report;
      x = next;
      report.iterations += to_int(method_.iterations());
      matrix_->multiply(x, r_);
      r_ = b_ - r_;
      report.residual = r_.norm() / norm;
      report.converged =
          report.residual <= options_.tolerance && equilibrated_norm(r_) <= options_.tolerance * equilibrated;
      if (report.iterations >= options_.max_iterations) break;
    }
    return report;
  }

 private:
  /// In the norm of the inverse diagonal blocks.
  double equilibrated_norm(const Field& r) const {
    double sum = 0;
    for (std::size_t i = 0; i < matrix_->vertices(); ++i) {
      const Eigen::Matrix<double, D, 1> at = r.template segment<D>(to_index(D * i));
      sum += at.dot(matrix_->diagonal(i).inverse() * at);
    }
    return std::sqrt(sum);
  }

  SolverOptions options_;
  CompressedColumns<D> columns_;
  Sparse full_;
  Method method_;
  const SystemMatrix<D>* matrix_ = nullptr;
  bool usable_ = false;
  Field b_, r_;
};

}  // namespace

template <int D>
std::unique_ptr<LinearSolver<D>> make_eigen_cg(const SolverOptions& options, EigenPreconditioner preconditioner) {
  constexpr int both = Eigen::Lower | Eigen::Upper;
  if (preconditioner == EigenPreconditioner::diagonal)
    return std::make_unique<EigenIterative<D, Eigen::ConjugateGradient<Sparse, both>>>(options);
  using Incomplete = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>>;
  return std::make_unique<EigenIterative<D, Eigen::ConjugateGradient<Sparse, both, Incomplete>>>(options);
}

template std::unique_ptr<LinearSolver<2>> make_eigen_cg(const SolverOptions&, EigenPreconditioner);
template std::unique_ptr<LinearSolver<3>> make_eigen_cg(const SolverOptions&, EigenPreconditioner);

}  // namespace cutbench
