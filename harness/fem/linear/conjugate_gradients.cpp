#include "harness/fem/linear/conjugate_gradients.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

// Rounding lets the residual that the recursion carries along run ahead of the true one; each restart from the true one
// gains some digits, until the accuracy of doubles is reached.
constexpr int max_restarts = 5;
// Where products in floats do until the first restart: their rounding is far below such a residual.
constexpr double tolerance_for_floats = 1e-3;

}  // namespace

template <int D>
void ConjugateGradients<D>::setup(const SystemMatrix<D>& a) {
  matrix_ = &a;
  auto& blocks = trials_.empty() ? inverse_ : diagonals_;  // nobody else wants them: inverted in place
  a.diagonals(blocks, *workers_);
  inverse_.resize(blocks.size());
  const int not_positive = workers_->sum_ranges(blocks.size(), [&](std::size_t begin, std::size_t end) {
    int n = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Block block = blocks[i];
      Block& inverse = inverse_[i];
      inverse = block.inverse();
      // Sylvester: the leading minors are positive; that of D - 1 rows is the determinant times the inverse's last
      // entry.
      n += !(block(0, 0) > 0 && block.determinant() > 0 && inverse(D - 1, D - 1) > 0);
    }
    return n;
  });
  positive_blocks_ = not_positive == 0;
  for (Trial& trial : trials_) trial.is_set_up = false;
  if (until_first_again_ > 0 && --until_first_again_ == 0) first_ = 0;
  trial_ = first_;
  prepare();
}

template <int D>
void ConjugateGradients<D>::prepare() {
  if (trial_ == trials_.size() || trials_[trial_].is_set_up) return;
  trials_[trial_].preconditioner->setup(*matrix_, diagonals_);
  trials_[trial_].is_set_up = true;
}

template <int D>
void ConjugateGradients<D>::give_up() {
  first_ = ++trial_;
  until_first_again_ = pause_;
  pause_ = std::min(2 * pause_, longest_pause);
  prepare();
}

template <int D>
auto ConjugateGradients<D>::advance(double step, Field& x) -> Products {
  // One pass over the vertices: the vectors don't fit the cache beside the matrix. Sums per coordinate, so that
  // additions don't wait for each other.
  return workers_->sum_ranges(inverse_.size(), [&](std::size_t begin, std::size_t end) -> Products {
    Vector rr = Vector::Zero(), rdr = Vector::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = to_index(D * i);
      x.template segment<D>(at) += step * p_.template segment<D>(at);
      const Vector r = r_.template segment<D>(at) - step * q_.template segment<D>(at);
      const Vector z = inverse_[i] * r;
      r_.template segment<D>(at) = r;
      z_.template segment<D>(at) = z;
      rr += r.cwiseProduct(r);
      rdr += r.cwiseProduct(z);
    }
    return {rr.sum(), rdr.sum(), rdr.sum()};
  });
}

/// Of values per vertex.
template <int D>
double ConjugateGradients<D>::dot(const Field& a, const Field& b) const {
  return workers_->sum_ranges(to_size(a.size()) / D, [&](std::size_t begin, std::size_t end) {
    const auto at = to_index(D * begin), n = to_index(D * (end - begin));
    return a.segment(at, n).dot(b.segment(at, n));
  });
}

template <int D>
void ConjugateGradients<D>::precondition(Products& now) {
  if (trial_ == trials_.size()) return;
  trials_[trial_].preconditioner->apply(r_, z_);
  now.rz = dot(r_, z_);
}

template <int D>
SolveReport ConjugateGradients<D>::solve(const Field& b, Field& x, const Field& start) {
  const SystemMatrix<D>& a = *matrix_;
  project(*a.held, b, b_);
  x.setZero(b.size());
  z_.resize(b.size());
  p_.setZero(b.size());
  q_.setZero(b.size());
  SolveReport report;
  if (b_.isZero(0)) {
    report.converged = true;
    return report;
  }
  trial_ = first_;
  prepare();
  r_ = b_;
  const Products all = advance(0, x);  // p = q = 0
  const double bb = all.rr, share = options_.tolerance * options_.tolerance, enough = share * bb,
               enough_rdr = share * all.rdr;
  // Whether products in floats do before the first restart: what is returned was judged by one in doubles.
  const auto floats_do = [&] { return options_.tolerance >= tolerance_for_floats && trial_ < trials_.size(); };
  if (start.size() == b.size()) {
    project(*a.held, start, x);
    if (!(floats_do() && trials_[trial_].preconditioner->multiply_roughly(x, q_))) a.multiply(x, q_, *workers_);
    r_ -= q_;
    if (!(r_.squaredNorm() < bb)) {
      x.setZero();
      r_ = b_;
    }
    q_.setZero();
  }
  for (int restart = 0, begun = 0;;) {
    const int left = options_.max_iterations - begun,
              most = begun + (trial_ < trials_.size() ? std::min(left, trials_[trial_].most_iterations) : left);
    if (trial_ < trials_.size()) trials_[trial_].preconditioner->solve_apart(b_, x, r_);
    Products now = advance(0, x);  // whatever the last round left in p and q, times 0
    precondition(now);
    p_ = z_;
    bool broken = !positive_blocks_;
    bool is_rough = restart == 0 && floats_do();
    while (!broken && (now.rr > enough || now.rdr > enough_rdr) && report.iterations < most) {
      is_rough = is_rough && trials_[trial_].preconditioner->multiply_roughly(p_, q_);
      if (!is_rough) a.multiply(p_, q_, *workers_);
      ++report.iterations;
      const double pap = dot(p_, q_);
      // Not positive definite (A, or the preconditioner), or not finite. Every comparison with NaN is false.
      broken = !(pap > 0 && now.rz > 0 && std::isfinite(pap) && std::isfinite(now.rz));
      if (broken) break;
      Products next = advance(now.rz / pap, x);
      if (next.rr > enough || next.rdr > enough_rdr) {
        precondition(next);
        const double again = next.rz / now.rz;
        workers_->for_ranges(inverse_.size(), [&](std::size_t begin, std::size_t end) {
          const auto at = to_index(D * begin), n = to_index(D * (end - begin));
          p_.segment(at, n) = z_.segment(at, n) + again * p_.segment(at, n);
        });
      }
      now = next;
    }
    a.multiply(x, q_, *workers_);
    r_ = b_ - q_;
    const double rr = r_.squaredNorm();
    report.residual = std::sqrt(rr / bb);
    report.converged = !broken && report.residual <= options_.tolerance && now.rdr <= enough_rdr && std::isfinite(bb);
    report.fell_back = trial_ > 0;
    if (report.converged && trial_ == 0) pause_ = first_pause;
    if (report.converged || report.iterations >= options_.max_iterations) return report;
    const bool gives_up =
        (broken && !is_rough) || !std::isfinite(rr) || restart == max_restarts || report.iterations >= most;
    if (gives_up && !(trial_ < trials_.size() && positive_blocks_ && std::isfinite(bb))) return report;
    if (gives_up) {
      give_up();
      restart = 0;
      begun = report.iterations;
      x.setZero();
      r_ = b_;
      p_.setZero();
      q_.setZero();
      continue;
    }
    ++restart;
  }
}

template class ConjugateGradients<2>;
template class ConjugateGradients<3>;

}  // namespace cutbench
