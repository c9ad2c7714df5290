#include "harness/fem/linear/system_matrix.h"

#include <algorithm>

#include "harness/base/conversions.h"

namespace cutbench {

/// Calls take(i, row i of A x), in any order. All parts row by row, so that each value of the product is written once.
template <int D>
template <class Take>
void SystemMatrix<D>::for_each_product(const Field& x, Workers& workers, const Take& take) const {
  spread<D>(x, x_, workers);
  workers.for_ranges(vertices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t ahead = std::min(i + rows_ahead, end - 1);
      blocks->prefetch_row(ahead);
      Lanes sum = blocks->row_product(i, x_);
      for (const auto& term : scalar) {
        term.matrix->prefetch_row(ahead);
        sum += term.factor * term.matrix->row_product(i, x_);
      }
      take(i, sum);
    }
  });
}

template <int D>
void SystemMatrix<D>::add_product(const Field& x, Field& y, Workers& workers) const {
  for_each_product(x, workers, [&](std::size_t i, Lanes sum) {
    for (std::size_t k = 0; k < D; ++k) y[to_index(D * i + k)] += sum[k];
  });
}

template <int D>
void SystemMatrix<D>::multiply(const Field& x, Field& y, Workers& workers) const {
  y.resize(x.size());
  for_each_product(x, workers, [&](std::size_t i, Lanes sum) {
    for (std::size_t k = 0; k < D; ++k) y[to_index(D * i + k)] = (*held)[D * i + k] ? 0 : sum[k];
  });
}

template <int D>
typename BlockMatrix<D>::Block SystemMatrix<D>::diagonal(std::size_t i) const {
  typename BlockMatrix<D>::Block a = BlockMatrix<D>::Block::Zero();
  if (!blocks->columns(i).empty()) a = blocks->block(blocks->first_slot(i));
  for (const auto& term : scalar)
    if (!term.matrix->columns(i).empty())
      a.diagonal().array() += term.factor * term.matrix->block(term.matrix->first_slot(i))(0);
  for (int k = 0; k < D; ++k)
    if ((*held)[D * i + to_size(k)]) {
      a.row(k).setZero();
      a.col(k).setZero();
      a(k, k) = 1;
    }
  return a;
}

/// Each row's block is in another line of the cache.
template <int D>
void SystemMatrix<D>::diagonals(std::vector<typename BlockMatrix<D>::Block>& all, Workers& workers) const {
  constexpr std::size_t ahead = 4 * rows_ahead;
  all.resize(vertices());
  workers.for_ranges(all.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t next = std::min(i + ahead, end - 1);
      blocks->prefetch_diagonal(next);
      for (const auto& term : scalar) term.matrix->prefetch_diagonal(next);
      all[i] = diagonal(i);
    }
  });
}

void project(const std::vector<std::uint8_t>& held, const Eigen::Ref<const Field>& b, Field& projected) {
  projected.resize(b.size());
  for (Eigen::Index u = 0; u < b.size(); ++u) projected[u] = held[to_size(u)] ? 0 : b[u];
}

template struct SystemMatrix<2>;
template struct SystemMatrix<3>;

}  // namespace cutbench
