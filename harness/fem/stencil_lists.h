// Stencils: which vertices a linear row, or three of them, reads and with what factors. Kept in lists of different
// lengths in one array, so that those near a cut can be rewritten and the rest stays where it is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cutbench {

/// What one deformed vertex contributes to three rows.
struct StencilTerm {
  std::int32_t vertex;
  std::array<double, 3> factor;
};

/// Lists of T, one after the other; one that outgrows its room moves to the end.
template <class T>
class Lists {
 public:
  std::size_t size() const { return lists_.size(); }
  void resize(std::size_t lists) { lists_.resize(lists); }
  std::span<const T> operator[](std::size_t i) const { return {items_.data() + lists_[i].begin, lists_[i].size}; }

  /// Room for half as many items again, before they have to be copied.
  void reserve_spare() { items_.reserve(items_.size() + items_.size() / 2); }

  /// \pre `items` is not part of this.
  void set(std::size_t i, std::span<const T> items) {
    make_room(i, items.size(), items.size());
    std::copy(items.begin(), items.end(), items_.data() + lists_[i].begin);
    lists_[i].size = static_cast<std::uint32_t>(items.size());
  }
  /// Into a list in rising order that does not hold it.
  void insert(std::size_t i, const T& item) {
    make_room(i, lists_[i].size + 1, lists_[i].size + 9);
    T* const begin = items_.data() + lists_[i].begin;
    T* at = begin + lists_[i].size++;
    for (; at != begin && item < at[-1]; --at) *at = at[-1];
    *at = item;
  }
  /// \pre the list holds it.
  void erase(std::size_t i, const T& item) {
    T* const begin = items_.data() + lists_[i].begin;
    T* const end = begin + lists_[i].size--;
    T* const at = std::find(begin, end, item);
    std::move(at + 1, end, at);
  }

 private:
  struct List {
    std::size_t begin = 0;
    std::uint32_t size = 0, capacity = 0;
  };
  void make_room(std::size_t i, std::size_t n, std::size_t capacity) {
    List& list = lists_[i];
    if (n <= list.capacity) return;
    const std::size_t from = list.begin;
    list.begin = items_.size();
    list.capacity = static_cast<std::uint32_t>(capacity);
    items_.resize(items_.size() + list.capacity);
    std::copy_n(items_.data() + from, list.size, items_.data() + list.begin);
  }

  std::vector<List> lists_;
  std::vector<T> items_;
};

}  // namespace cutbench
