// Rows of different lengths in one array: what a cut touches is rewritten, and the rest stays where it is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace cutbench {

/// Room for half as many items again, before they have to be copied. It is written to: a page that nobody has touched
/// yet costs more than the rows of a cut that go there.
template <class... Vectors>
void reserve_spare(Vectors&... vectors) {
  const auto reserve = [](auto& vector) {
    const std::size_t n = vector.size();
    if (n == 0) return;
    vector.resize(n + n / 2);
    std::memset(static_cast<void*>(vector.data() + n), 0, (vector.size() - n) * sizeof vector[0]);
    vector.resize(n);
  };
  (reserve(vectors), ...);
}

/// Rows of T, one after the other. A row that outgrows its room moves to the end; its old place stays unused.
template <class T>
class GrowingRows {
 public:
  std::size_t size() const { return rows_.size(); }
  void resize(std::size_t rows) { rows_.resize(rows); }
  std::span<const T> operator[](std::size_t i) const { return {items_.data() + rows_[i].begin, rows_[i].size}; }
  /// Where row i begins in the array, and how long the array is, abandoned places included: for values kept beside it.
  std::size_t begin(std::size_t i) const { return rows_[i].begin; }
  std::size_t slots() const { return items_.size(); }

  /// Room for half as many rows and items again, before they have to be copied.
  void reserve_spare() { cutbench::reserve_spare(rows_, items_); }

  /// \pre `items` is not part of this.
  void set(std::size_t i, std::span<const T> items) {
    make_room(i, items.size(), items.size());
    std::copy(items.begin(), items.end(), items_.data() + rows_[i].begin);
    rows_[i].size = static_cast<std::uint32_t>(items.size());
  }
  /// At the end of row i.
  void append(std::size_t i, const T& item) {
    make_room(i, rows_[i].size + 1, std::max<std::size_t>(8, 2 * rows_[i].capacity));
    items_[rows_[i].begin + rows_[i].size++] = item;
  }
  /// Into a row in rising order that does not hold it.
  void insert(std::size_t i, const T& item) {
    make_room(i, rows_[i].size + 1, rows_[i].size + 9);
    T* const begin = items_.data() + rows_[i].begin;
    T* at = begin + rows_[i].size++;
    for (; at != begin && item < at[-1]; --at) *at = at[-1];
    *at = item;
  }
  /// In place of its equal. \pre row i holds that.
  void replace(std::size_t i, const T& item) {
    T* const begin = items_.data() + rows_[i].begin;
    *std::find(begin, begin + rows_[i].size, item) = item;
  }
  /// The others keep their order. \pre row i holds it.
  void erase(std::size_t i, const T& item) {
    T* const begin = items_.data() + rows_[i].begin;
    T* const end = begin + rows_[i].size--;
    T* const at = std::find(begin, end, item);
    std::move(at + 1, end, at);
  }

 private:
  struct Row {
    std::size_t begin = 0;
    std::uint32_t size = 0, capacity = 0;
  };
  void make_room(std::size_t i, std::size_t n, std::size_t capacity) {
    Row& row = rows_[i];
    if (n <= row.capacity) return;
    const std::size_t from = row.begin;
    row.begin = items_.size();
    row.capacity = static_cast<std::uint32_t>(capacity);
    items_.resize(items_.size() + row.capacity);
    std::copy_n(items_.data() + from, row.size, items_.data() + row.begin);
  }

  std::vector<Row> rows_;
  std::vector<T> items_;
};

}  // namespace cutbench
