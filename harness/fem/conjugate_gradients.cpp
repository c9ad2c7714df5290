#include "harness/fem/conjugate_gradients.h"

#include <Eigen/LU>
#include <cmath>

namespace cutbench {

namespace {

// Rounding lets the residual that the recursion carries along run ahead of the true one; each restart from the true one
// gains some digits, until the accuracy of doubles is reached.
constexpr int max_restarts = 5;

}  // namespace

template <int D>
void ConjugateGradients<D>::setup(const SystemMatrix<D>& a) {
  matrix_ = &a;
  inverse_.resize(a.vertices());
  positive_blocks_ = true;
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    const Block block = a.diagonal(i);
    inverse_[i] = block.inverse();
    // Sylvester: the leading minors are positive; that of D - 1 rows is the determinant times the inverse's last entry.
    positive_blocks_ = positive_blocks_ && block(0, 0) > 0 && block.determinant() > 0 && inverse_[i](D - 1, D - 1) > 0;
  }
  if (!use_sliver_blocks_) return;
  sliver_blocks_.setup(a);
  for (const auto& group : sliver_blocks_.groups())
    for (const std::int32_t i : group.vertices) inverse_[static_cast<std::size_t>(i)].setZero();
}

template <int D>
auto ConjugateGradients<D>::advance(double step, Field& x) -> Products {
  // One pass over the vertices: the vectors don't fit the cache beside the matrix. Sums per coordinate, so that
  // additions don't wait for each other.
  Vector rr = Vector::Zero(), rz = Vector::Zero();
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(D * i);
    x.template segment<D>(at) += step * p_.template segment<D>(at);
    const Vector r = r_.template segment<D>(at) - step * q_.template segment<D>(at);
    const Vector z = inverse_[i] * r;
    r_.template segment<D>(at) = r;
    z_.template segment<D>(at) = z;
    rr += r.cwiseProduct(r);
    rz += r.cwiseProduct(z);
  }
  const double of_slivers = use_sliver_blocks_ ? sliver_blocks_.apply(r_, z_) : 0;
  return {rr.sum(), rz.sum() + of_slivers};
}

template <int D>
SolveReport ConjugateGradients<D>::solve(const Field& b, Field& x) {
  const SystemMatrix<D>& a = *matrix_;
  project(*a.held, b, b_);
  x.setZero(b.size()), z_.resize(b.size()), p_.setZero(b.size()), q_.setZero(b.size());
  SolveReport report;
  if (b_.isZero(0)) {
    report.converged = true;
    return report;
  }
  r_ = b_;
  const double bb = b_.squaredNorm();
  // The residual must be small as preconditioned, too: where |b| is all a sliver's huge forces, the rest of the sheet
  // could be anything.
  const double enough = options_.tolerance * options_.tolerance * bb;
  double enough_z = 0, last_z = 0;
  for (int restart = 0;; ++restart) {
    Products now = advance(0, x);  // p = q = 0, or what the last round left, times 0
    if (restart == 0) enough_z = options_.tolerance * options_.tolerance * now.rz;
    p_ = z_;
    bool broken = !positive_blocks_;
    while (!broken && (now.rr > enough || now.rz > enough_z) && report.iterations < options_.max_iterations) {
      a.multiply(p_, q_);
      ++report.iterations;
      const double pap = p_.dot(q_);
      // Not positive definite (A, or the preconditioner), or not finite. Every comparison with NaN is false.
      broken = !(pap > 0 && now.rz > 0 && std::isfinite(pap) && std::isfinite(now.rz));
      if (broken) break;
      const Products next = advance(now.rz / pap, x);
      p_ = z_ + (next.rz / now.rz) * p_;
      now = next;
    }
    last_z = now.rz;
    a.multiply(x, q_);
    r_ = b_ - q_;
    const double rr = r_.squaredNorm();
    report.residual = std::sqrt(rr / bb);
    report.converged = !broken && report.residual <= options_.tolerance && last_z <= enough_z && std::isfinite(bb);
    if (report.converged || broken || !std::isfinite(rr) || restart == max_restarts ||
        report.iterations >= options_.max_iterations)
      return report;
  }
}

template class ConjugateGradients<2>;
template class ConjugateGradients<3>;

}  // namespace cutbench
