// When each row of a matrix changed last, so that what is derived from the matrix can follow row by row.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

namespace cutbench {

/// Each change has a number. Numbers rise, and are unique in the program: two copies of a matrix that are changed apart
/// never have the same one.
class PatternHistory {
 public:
  void begin_change() { numbers_.push_back(next()); }
  void resize(std::size_t rows) { changed_in_.resize(rows, 0); }
  /// Row i changes: its pattern, its values that are not assembled anew each time, its place or which unknowns are held.
  void mark(std::size_t row) { changed_in_[row] = numbers_.back(); }

  std::uint64_t now() const { return numbers_.empty() ? 0 : numbers_.back(); }
  /// Whether the matrix has come from this change by those after it.
  bool holds(std::uint64_t number) const { return std::binary_search(numbers_.begin(), numbers_.end(), number); }
  /// \pre holds(number), and the row was there
  bool changed_since(std::uint64_t number, std::size_t row) const { return changed_in_[row] > number; }

 private:
  static std::uint64_t next() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }
  std::vector<std::uint64_t> numbers_, changed_in_;  // the second: per row
};

}  // namespace cutbench
