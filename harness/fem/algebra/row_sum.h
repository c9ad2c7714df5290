// A sparse row that is summed up, in any order of its columns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/conversions.h"

namespace cutbench {

template <class Value>
class RowSum {
 public:
  explicit RowSum(const Value& zero) : zero_(zero) {}
  /// Before rows with columns below `columns`.
  void resize(std::size_t columns) {
    if (columns > place_.size()) {
      place_.resize(columns, -1);
      columns_.resize(columns + 1);
      sums_.resize(columns + 1, zero_);
    }
  }
  /// The sum of a column, which begins at zero. Whether a column is new is a coin toss, so there is no branch: it is
  /// written behind the last one in any case.
  Value& operator[](std::int32_t column) {
    std::int32_t& place = place_[to_size(column)];
    const bool is_new = place < 0;
    place = is_new ? to_int32(size_) : place;
    columns_[size_] = column;
    size_ += is_new;
    return sums_[to_size(place)];
  }
  std::span<const std::int32_t> columns() const { return {columns_.data(), size_}; }
  std::span<const Value> sums() const { return {sums_.data(), size_}; }
  void clear() {
    for (std::size_t k = 0; k < size_; ++k) {
      place_[to_size(columns_[k])] = -1;
      sums_[k] = zero_;
    }
    size_ = 0;
  }

 private:
  Value zero_;
  std::size_t size_ = 0;
  std::vector<std::int32_t> place_;    // per column: in the row, or -1
  std::vector<std::int32_t> columns_;  // room for one more than all
  std::vector<Value> sums_;            // zero behind the row
};

}  // namespace cutbench
