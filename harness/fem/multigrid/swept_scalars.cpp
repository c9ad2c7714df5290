#include "harness/fem/multigrid/swept_scalars.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/base/conversions.h"

namespace cutbench {

void SweptScalars::follow(const LevelRows& rows, std::span<const std::int32_t> changed) {
  near_.resize(rows.size());
  left_out_.resize(rows.size());
  find_scales(rows, changed);
  for (const std::int32_t row : changed) take(rows, to_size(row));
}

void SweptScalars::follow(const LevelRows& rows) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  near_ = {};
  scale_.clear();
  follow(rows, all);
  near_.reserve_spare();
  cutbench::reserve_spare(values_, scale_, left_out_);
}

/// A row keeps its scale as long as it is there, so that both rows of an entry leave it out or none does. That of a
/// sliver is no larger than the median: two vertices that a sliver constraints move together, and what is small beside
/// that constraint is not small beside what holds them both.
void SweptScalars::find_scales(const LevelRows& rows, std::span<const std::int32_t> changed) {
  const bool is_first = scale_.empty();
  scale_.resize(rows.size());
  for (const std::int32_t row : changed) {
    const auto i = to_size(row);
    if (rows.scalars[i].empty())
      scale_[i] = 0;
    else if (scale_[i] == 0)
      scale_[i] = std::abs(rows.scalar[rows.scalars.diagonal_slot(i)]);
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

/// Whether a scalar is small is a coin toss, so there is no branch.
void SweptScalars::take(const LevelRows& rows, std::size_t i) {
  const auto all = rows.scalars[i];
  columns_.resize(all.size());
  taken_.resize(all.size());
  double left_out = 0;
  std::size_t slot = rows.scalars.first_slot(i), n = 0, own = 0;
  for (const std::int32_t column : all) {
    const double value = rows.scalar[slot++];
    const auto j = to_size(column);
    const bool leave_out = j != i && is_small(i, j, value);
    left_out += leave_out ? value : 0;
    own = j == i ? n : own;
    columns_[n] = column;
    taken_[n] = value;
    n += !leave_out;
  }
  columns_.resize(n);
  if (n > 0) taken_[own] += left_out;
  left_out_[i] = left_out;
  near_.set_in_order(i, columns_, own);
  values_.resize(near_.slots());
  std::copy_n(taken_.begin(), n, values_.begin() + to_index(near_.first_slot(i)));
}

}  // namespace cutbench
