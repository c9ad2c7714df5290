#include "harness/fem/level_matrix.h"

#include <numeric>

namespace cutbench {

template <int D, class S>
void LevelMatrix<D, S>::follow(const LevelRows& rows, std::span<const std::int32_t> changed) {
  rows_ = &rows;
  blocks_.resize(D * D * rows.blocks.slots() + padding), scalars_.resize(rows.scalars.slots());
  inverse_.resize(D * D * rows.size() + padding);
  for (const std::int32_t row : changed) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t first = rows.scalars.first_slot(i);
    for (std::size_t slot = first; slot < first + rows.scalars[i].size(); ++slot)
      scalars_[slot] = static_cast<S>(rows.scalar[slot]);
  }
}

template <int D, class S>
void LevelMatrix<D, S>::follow(const LevelRows& rows) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  follow(rows, all);
  for (Vector* values : {&blocks_, &scalars_, &inverse_}) values->reserve(values->size() + values->size() / 2);
}

template <int D, class S>
auto LevelMatrix<D, S>::diagonal(std::size_t i) const -> Block {
  Block all = Eigen::Map<const Eigen::Matrix<S, D, D>>(block(rows_->blocks.diagonal_slot(i))).template cast<double>();
  if (!rows_->scalars[i].empty())
    all.diagonal().array() += static_cast<double>(scalars_[rows_->scalars.diagonal_slot(i)]);
  return all;
}

template <int D, class S>
Eigen::MatrixXd LevelMatrix<D, S>::dense() const {
  const auto n = static_cast<Eigen::Index>(D * size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < size(); ++i) {
    const auto at = static_cast<Eigen::Index>(D * i);
    std::size_t slot = rows_->blocks.first_slot(i), scalar = rows_->scalars.first_slot(i);
    for (const std::int32_t j : rows_->blocks[i])
      all.block<D, D>(at, D * j) += Eigen::Map<const Eigen::Matrix<S, D, D>>(block(slot++)).template cast<double>();
    for (const std::int32_t j : rows_->scalars[i])
      all.block<D, D>(at, D * j).diagonal().array() += static_cast<double>(scalars_[scalar++]);
  }
  return all;
}

/// Subtracts entries times z from a sum. Four values at a time: the last of three belongs to the neighbour and is
/// ignored at the end. Several sums in turns, so that subtractions don't wait for each other.
template <int D, class S>
void LevelMatrix<D, S>::subtract_blocks(std::size_t slot, Columns columns, const Vector& z, Sum& sum) const {
  const S* a = block(slot);
  const auto next = [&](std::int32_t column) -> Sum {
    const S* x = z.data() + D * column;
    Sum part = Eigen::Map<const Sum>(a) * x[0];
    for (int c = 1; c < D; ++c) part += Eigen::Map<const Sum>(a + D * c) * x[c];
    a += D * D;
    return part;
  };
  Sum other = Sum::Zero();
  std::size_t k = 0;
  for (; k + 2 <= columns.size(); k += 2) sum -= next(columns[k]), other -= next(columns[k + 1]);
  if (k < columns.size()) other -= next(columns[k]);
  sum += other;
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_scalars(std::size_t slot, Columns columns, const Vector& z, Sum& sum) const {
  const S* a = scalars_.data() + slot;
  const auto term = [&](std::size_t k) -> Sum { return a[k] * Eigen::Map<const Sum>(z.data() + D * columns[k]); };
  Sum other = Sum::Zero(), third = Sum::Zero(), fourth = Sum::Zero();
  std::size_t k = 0;
  for (; k + 4 <= columns.size(); k += 4)
    sum -= term(k), other -= term(k + 1), third -= term(k + 2), fourth -= term(k + 3);
  for (; k < columns.size(); ++k) other -= term(k);
  sum += (other + third) + fourth;
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_below(std::size_t i, const Vector& z, Sum& sum) const {
  subtract_blocks(rows_->blocks.first_slot(i), rows_->blocks.below(i), z, sum);
  if (!rows_->scalars[i].empty()) subtract_scalars(rows_->scalars.first_slot(i), rows_->scalars.below(i), z, sum);
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_above(std::size_t i, const Vector& z, Sum& sum) const {
  subtract_blocks(rows_->blocks.diagonal_slot(i) + 1, rows_->blocks.above(i), z, sum);
  if (!rows_->scalars[i].empty())
    subtract_scalars(rows_->scalars.diagonal_slot(i) + 1, rows_->scalars.above(i), z, sum);
}

/// z at row i from the residual that the other rows leave.
template <int D, class S>
void LevelMatrix<D, S>::relax(std::size_t i, const Sum& residual, Vector& z) const {
  const S* inverse = inverse_.data() + D * D * i;
  Sum solved = Sum::Zero();
  for (int c = 0; c < D; ++c) solved += Eigen::Map<const Sum>(inverse + D * c) * residual[c];
  for (int c = 0; c < D; ++c) z[D * i + static_cast<std::size_t>(c)] = solved[c];
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_forwards(const Vector& r, Vector& z, Vector& t) const {
  for (std::size_t i = 0; i < size(); ++i) {
    Sum sum = Sum::Zero();
    if (!rows_->blocks[i].empty()) {
      sum = Eigen::Map<const Sum>(r.data() + D * i);
      subtract_below(i, z, sum);
    }
    relax(i, sum, z);
  }
  for (std::size_t i = 0; i < size(); ++i) {
    Sum sum = Sum::Zero();
    if (!rows_->blocks[i].empty()) subtract_above(i, z, sum);
    for (int c = 0; c < D; ++c) t[D * i + static_cast<std::size_t>(c)] = sum[c];
  }
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_backwards(const Vector& r, Vector& z) const {
  for (std::size_t i = size(); i-- > 0;) {
    if (rows_->blocks[i].empty()) continue;
    Sum sum = Eigen::Map<const Sum>(r.data() + D * i);
    subtract_below(i, z, sum), subtract_above(i, z, sum);
    relax(i, sum, z);
  }
}

template class LevelMatrix<2, float>;
template class LevelMatrix<3, float>;
template class LevelMatrix<2, double>;
template class LevelMatrix<3, double>;

}  // namespace cutbench
