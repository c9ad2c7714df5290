#include "harness/fem/solvers/factor_preconditioners.h"

#include <cmath>
#include <limits>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr int most_uses = 10;         // iterations that an old factor may cost before a new one is made
constexpr double same_traces = 0.01;  // the sum of changes over the sum of sizes; stresses change traces a little

/// Conjugate gradients give up a preconditioner that is not finite, and say so.
void refuse(Field& z) { z.setConstant(std::numeric_limits<double>::quiet_NaN()); }

}  // namespace

template <int D>
void StaleFactor<D>::setup(const SystemMatrix<D>& a) {
  if (!factored_ || uses_ > most_uses || factor_->is_new(a)) factored_ = factor_->factor(a);
  uses_ = 0;
}

template <int D>
void StaleFactor<D>::apply(const Field& r, Field& z) {
  ++uses_;
  right_ = r;
  if (!factored_ || !factor_->solve(right_, solution_)) return refuse(z);
  z = solution_;
}

/// True where the traces are others than those that were factored, and then takes them.
template <int D>
bool ConstantFactor<D>::set_traces(const SystemMatrix<D>& a) {
  const bool is_new = matrix_.pattern != a.pattern || traces_.rows() != a.vertices() || matrix_.blocks == nullptr;
  if (is_new) {
    traces_.resize(a.vertices());
    for (std::size_t i = 0; i < a.vertices(); ++i) traces_.set_row(i, a.blocks->columns(i));
  }
  const auto for_each = [&](const auto& visit) {
    for (std::size_t i = 0; i < a.vertices(); ++i) {
      std::int32_t from = a.blocks->first_slot(i), to = traces_.first_slot(i);
      for (std::size_t k = 0; k < a.blocks->columns(i).size(); ++k)
        visit(traces_.block(to++)(0), a.blocks->block(from++).trace() / D);
    }
  };
  double change = 0, size = 0;
  for_each([&](double mine, double trace) {
    change += std::abs(trace - mine);
    size += std::abs(trace);
  });
  if (!is_new && change <= same_traces * size) return false;
  for_each([](double& mine, double trace) { mine = trace; });
  return true;
}

template <int D>
void ConstantFactor<D>::setup(const SystemMatrix<D>& a) {
  bool is_new = set_traces(a);
  std::vector<std::uint8_t> held(a.vertices(), 1);
  for (std::size_t u = 0; u < a.held->size(); ++u) held[u / D] &= (*a.held)[u];
  std::vector<double> factors;
  for (const auto& term : a.scalar) factors.push_back(term.factor);
  is_new = is_new || held != held_ || factors != factors_ || !factored_;
  held_ = std::move(held);
  factors_ = std::move(factors);
  held_unknowns_ = a.held;
  matrix_.blocks = &traces_;
  matrix_.held = &held_;
  matrix_.pattern = a.pattern;
  matrix_.scalar.clear();
  for (const auto& term : a.scalar) matrix_.scalar.push_back({term.factor, term.matrix});
  if (is_new) factored_ = factor_->factor(matrix_);
}

template <int D>
void ConstantFactor<D>::apply(const Field& r, Field& z) {
  const Eigen::Index n = r.size() / D;
  right_ = Eigen::Map<const Eigen::MatrixXd>(r.data(), D, n).transpose();  // a column per coordinate
  if (!factored_ || !factor_->solve(right_, solution_)) return refuse(z);
  for (Eigen::Index u = 0; u < r.size(); ++u) z[u] = (*held_unknowns_)[to_size(u)] ? 0 : solution_(u / D, u % D);
}

template class StaleFactor<2>;
template class StaleFactor<3>;
template class ConstantFactor<2>;
template class ConstantFactor<3>;

}  // namespace cutbench
