// Which rows of a matrix changed when, so that what is derived from the matrix can follow row by row.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/conversions.h"

namespace cutbench {

/// Each change has a number. Numbers rise, and are unique in the program: two copies of a matrix that are changed apart
/// never have the same one.
class PatternHistory {
 public:
  void begin_change() {
    numbers_.push_back(next());
    first_.push_back(rows_.size());
  }
  /// The row changes: its pattern, its values that are not assembled anew each time, its place or which unknowns are
  /// held.
  void mark(std::size_t row) { rows_.push_back(to_int32(row)); }

  std::uint64_t now() const { return numbers_.empty() ? 0 : numbers_.back(); }
  /// Whether the matrix has come from this change by those after it.
  bool holds(std::uint64_t number) const { return std::binary_search(numbers_.begin(), numbers_.end(), number); }
  /// The rows that changes after this one have marked; a row may be there more than once. \pre holds(number)
  std::span<const std::int32_t> changed_since(std::uint64_t number) const {
    const auto next = std::upper_bound(numbers_.begin(), numbers_.end(), number);
    const auto first = next == numbers_.end() ? rows_.size() : first_[to_size(next - numbers_.begin())];
    return std::span(rows_).subspan(first);
  }

 private:
  static std::uint64_t next() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }
  std::vector<std::uint64_t> numbers_;
  std::vector<std::size_t> first_;  // per change: where its rows begin
  std::vector<std::int32_t> rows_;
};

}  // namespace cutbench
