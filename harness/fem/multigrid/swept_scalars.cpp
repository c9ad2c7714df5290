#include "harness/fem/multigrid/swept_scalars.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr double small = 0.01;  // of the smaller of two rows' scales

}  // namespace

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

bool SweptScalars::is_small(std::size_t i, std::size_t j, double value) const {
  return std::abs(value) < small * std::min(scale_[i], scale_[j]);
}

void SweptScalars::take(const LevelRows& rows, std::size_t i) {
  columns_.clear();
  taken_.clear();
  double left_out = 0;
  std::size_t slot = rows.scalars.first_slot(i), own = 0;
  for (const std::int32_t column : rows.scalars[i]) {
    const double value = rows.scalar[slot++];
    const auto j = to_size(column);
    if (j != i && is_small(i, j, value)) {
      left_out += value;
      continue;
    }
    if (j == i) own = taken_.size();
    columns_.push_back(column);
    taken_.push_back(value);
  }
  if (!columns_.empty()) taken_[own] += left_out;
  left_out_[i] = left_out;
  near_.set(i, columns_);
  values_.resize(near_.slots());
  std::copy(taken_.begin(), taken_.end(), values_.begin() + to_index(near_.first_slot(i)));
}

}  // namespace cutbench
