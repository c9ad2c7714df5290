#include "harness/fem/multigrid/level_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/base/conversions.h"
#include "harness/base/prefetch.h"

namespace cutbench {

namespace {

constexpr double small = 0.01;  // of the smaller of two rows' scales

}  // namespace

template <int D, class S>
void LevelMatrix<D, S>::follow(const LevelRows& rows, std::span<const std::int32_t> changed) {
  rows_ = &rows;
  blocks_.resize(D * D * rows.blocks.slots() + padding);
  inverse_.resize(D * D * rows.size() + padding);
  near_.resize(rows.size());
  left_out_.resize(rows.size());
  find_scales(changed);
  for (const std::int32_t row : changed) take_scalars(to_size(row));
}

/// A row keeps its scale as long as it is there, so that both rows of an entry leave it out or none does. That of a
/// sliver is no larger than the median: two vertices that a sliver constraints move together, and what is small beside
/// that constraint is not small beside what holds them both.
template <int D, class S>
void LevelMatrix<D, S>::find_scales(std::span<const std::int32_t> changed) {
  const bool is_first = scale_.empty();
  scale_.resize(rows_->size());
  for (const std::int32_t row : changed) {
    const auto i = to_size(row);
    if (rows_->scalars[i].empty())
      scale_[i] = 0;
    else if (scale_[i] == 0)
      scale_[i] = std::abs(rows_->scalar[rows_->scalars.diagonal_slot(i)]);
  }
  if (is_first) {
    std::vector<double> sorted;
    for (const double scale : scale_)
      if (scale > 0 && std::isfinite(scale)) sorted.push_back(scale);
    const auto middle = sorted.begin() + to_index(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    median_scale_ = sorted.empty() ? 0 : *middle;
  }
  for (const std::int32_t row : changed) {
    auto& scale = scale_[to_size(row)];
    scale = std::min(scale, median_scale_);
  }
}

template <int D, class S>
void LevelMatrix<D, S>::take_scalars(std::size_t i) {
  columns_.clear();
  values_.clear();
  double left_out = 0;
  std::size_t slot = rows_->scalars.first_slot(i), own = 0;
  for (const std::int32_t column : rows_->scalars[i]) {
    const double value = rows_->scalar[slot++];
    const auto j = to_size(column);
    if (j != i && std::abs(value) < small * std::min(scale_[i], scale_[j])) {
      left_out += value;
      continue;
    }
    if (j == i) own = values_.size();
    columns_.push_back(column);
    values_.push_back(static_cast<S>(value));
  }
  if (!columns_.empty()) values_[own] += static_cast<S>(left_out);
  left_out_[i] = left_out;
  near_.set(i, columns_);
  scalars_.resize(near_.slots());
  std::copy(values_.begin(), values_.end(), scalars_.begin() + to_index(near_.first_slot(i)));
}

template <int D, class S>
std::size_t LevelMatrix<D, S>::scalar_count() const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) n += near_[i].size();
  return n;
}

template <int D, class S>
void LevelMatrix<D, S>::follow(const LevelRows& rows) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  near_ = {};
  scale_.clear();
  follow(rows, all);
  near_.reserve_spare();
  cutbench::reserve_spare(blocks_, scalars_, inverse_, scale_, left_out_);
}

template <int D, class S>
auto LevelMatrix<D, S>::diagonal(std::size_t i) const -> Block {
  Block all = Eigen::Map<const Eigen::Matrix<S, D, D>>(block(rows_->blocks.diagonal_slot(i))).template cast<double>();
  if (!near_[i].empty()) all.diagonal().array() += to_double(scalars_[near_.diagonal_slot(i)]);
  return all;
}

template <int D, class S>
Eigen::MatrixXd LevelMatrix<D, S>::dense() const {
  const auto n = to_index(D * size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < size(); ++i) {
    const auto at = to_index(D * i);
    std::size_t slot = rows_->blocks.first_slot(i), scalar = rows_->scalars.first_slot(i);
    for (const std::int32_t j : rows_->blocks[i])
      all.block<D, D>(at, D * j) += Eigen::Map<const Eigen::Matrix<S, D, D>>(block(slot++)).template cast<double>();
    for (const std::int32_t j : rows_->scalars[i])
      all.block<D, D>(at, D * j).diagonal().array() += rows_->scalar[scalar++];
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
  for (; k + 2 <= columns.size(); k += 2) {
    sum -= next(columns[k]);
    other -= next(columns[k + 1]);
  }
  if (k < columns.size()) other -= next(columns[k]);
  sum += other;
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_scalars(std::size_t slot, Columns columns, const Vector& z, Sum& sum) const {
  const S* a = scalars_.data() + slot;
  const auto term = [&](std::size_t k) -> Sum { return a[k] * Eigen::Map<const Sum>(z.data() + D * columns[k]); };
  Sum other = Sum::Zero(), third = Sum::Zero(), fourth = Sum::Zero();
  std::size_t k = 0;
  for (; k + 4 <= columns.size(); k += 4) {
    sum -= term(k);
    other -= term(k + 1);
    third -= term(k + 2);
    fourth -= term(k + 3);
  }
  for (; k < columns.size(); ++k) other -= term(k);
  sum += (other + third) + fourth;
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_below(std::size_t i, const Vector& z, Sum& sum) const {
  subtract_blocks(rows_->blocks.first_slot(i), rows_->blocks.below(i), z, sum);
  if (!near_[i].empty()) subtract_scalars(near_.first_slot(i), near_.below(i), z, sum);
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_above(std::size_t i, const Vector& z, Sum& sum) const {
  subtract_blocks(rows_->blocks.diagonal_slot(i) + 1, rows_->blocks.above(i), z, sum);
  if (!near_[i].empty()) subtract_scalars(near_.diagonal_slot(i) + 1, near_.above(i), z, sum);
}

template <int D, class S>
auto LevelMatrix<D, S>::times_inverse(std::size_t i, const Sum& residual) const -> Sum {
  const S* inverse = inverse_.data() + D * D * i;
  Sum solved = Sum::Zero();
  for (int c = 0; c < D; ++c) solved += Eigen::Map<const Sum>(inverse + D * c) * residual[c];
  return solved;
}

template <int D, class S>
void LevelMatrix<D, S>::prefetch_row(std::size_t i) const {
  prefetch(rows_->blocks[i].data(), rows_->blocks[i].size());
  prefetch(block(rows_->blocks.first_slot(i)), D * D * rows_->blocks[i].size());
  prefetch(near_[i].data(), near_[i].size());
  prefetch(scalars_.data() + near_.first_slot(i), near_[i].size());
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_forwards(const Vector& r, Vector& z, Vector& t) const {
  const std::size_t last = size() - 1;  // no row is looked at where there is none
  for (std::size_t i = 0; i < size(); ++i) {
    prefetch_row(std::min(i + rows_ahead, last));
    Sum sum = Sum::Zero();
    if (!rows_->blocks[i].empty()) {
      sum = Eigen::Map<const Sum>(r.data() + D * i);
      subtract_below(i, z, sum);
    }
    const Sum solved = times_inverse(i, sum);
    for (int c = 0; c < D; ++c) z[D * i + to_size(c)] = solved[c];
  }
  for (std::size_t i = 0; i < size(); ++i) {
    prefetch_row(std::min(i + rows_ahead, last));
    Sum sum = Sum::Zero();
    if (!rows_->blocks[i].empty()) subtract_above(i, z, sum);
    for (int c = 0; c < D; ++c) t[D * i + to_size(c)] = sum[c];
  }
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_backwards(const Vector& r, Vector& z) const {
  for (std::size_t i = size(); i-- > 0;) {
    prefetch_row(i - std::min(i, rows_ahead));
    if (rows_->blocks[i].empty()) continue;
    // The row with its diagonal: two loops over entries that follow each other, not four.
    Sum left = Eigen::Map<const Sum>(r.data() + D * i);
    subtract_blocks(rows_->blocks.first_slot(i), rows_->blocks[i], z, left);
    subtract_scalars(near_.first_slot(i), near_[i], z, left);
    const Sum solved = times_inverse(i, left);
    for (int c = 0; c < D; ++c) z[D * i + to_size(c)] += solved[c];
  }
}

template class LevelMatrix<2, float>;
template class LevelMatrix<3, float>;
template class LevelMatrix<2, double>;
template class LevelMatrix<3, double>;

}  // namespace cutbench
