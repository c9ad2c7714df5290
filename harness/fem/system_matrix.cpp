#include "harness/fem/system_matrix.h"

namespace cutbench {

template <int D>
void SystemMatrix<D>::add_product(const Field& x, Field& y) const {
  blocks->add_product(1, x, y);
  for (const auto& term : scalar) add_product_per_coordinate(*term.matrix, D, term.factor, x, y);
}

template <int D>
void SystemMatrix<D>::multiply(const Field& x, Field& y) const {
  // All parts row by row, so that y is written once: the product is bound by memory.
  using Vector = Eigen::Matrix<double, D, 1>;
  const auto at = [&](std::int32_t j) { return Eigen::Map<const Vector>(x.data() + D * j); };
  y.resize(x.size());
  for (std::size_t i = 0; i < vertices(); ++i) {
    Vector sum = Vector::Zero();
    std::int32_t slot = blocks->first_slot(i);
    for (const auto j : blocks->columns(i)) sum.noalias() += blocks->block(slot++) * at(j);
    for (const auto& term : scalar) {
      Vector part = Vector::Zero();
      slot = term.matrix->first_slot(i);
      for (const auto j : term.matrix->columns(i)) part += term.matrix->block(slot++)(0) * at(j);
      sum += term.factor * part;
    }
    for (std::size_t k = 0; k < D; ++k)
      y[static_cast<Eigen::Index>(D * i + k)] = (*held)[D * i + k] ? 0 : sum[static_cast<Eigen::Index>(k)];
  }
}

template <int D>
typename BlockMatrix<D>::Block SystemMatrix<D>::diagonal(std::size_t i) const {
  typename BlockMatrix<D>::Block a = BlockMatrix<D>::Block::Zero();
  if (!blocks->columns(i).empty()) a = blocks->block(blocks->first_slot(i));
  for (const auto& term : scalar)
    if (!term.matrix->columns(i).empty())
      a.diagonal().array() += term.factor * term.matrix->block(term.matrix->first_slot(i))(0);
  for (int k = 0; k < D; ++k)
    if ((*held)[D * i + static_cast<std::size_t>(k)]) a.row(k).setZero(), a.col(k).setZero(), a(k, k) = 1;
  return a;
}

template struct SystemMatrix<2>;
template struct SystemMatrix<3>;

}  // namespace cutbench
