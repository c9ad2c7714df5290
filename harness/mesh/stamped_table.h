// A value per index that is emptied at no cost: for working storage as large as the sheet, of which one use touches
// little.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace cutbench {

template <class Key, class Value>
class StampedTable {
 public:
  /// Empties it. Keys below `size` may be used from now on.
  void clear(std::size_t size) {
    grow(size);
    if (++stamp_ == 0) {
      entries_.assign(entries_.size(), {});
      stamp_ = 1;
    }
  }
  /// Makes room for keys below `size`, and keeps what is there.
  void grow(std::size_t size) {
    if (entries_.size() < size) entries_.resize(size);
  }
  std::size_t size() const { return entries_.size(); }

  bool holds(Key key) const { return entries_[key()].stamp == stamp_; }
  /// \pre holds(key)
  Value& at(Key key) { return entries_[key()].value; }
  const Value& at(Key key) const { return entries_[key()].value; }
  /// What it holds there, or `otherwise`.
  Value get(Key key, Value otherwise) const { return holds(key) ? at(key) : otherwise; }
  void set(Key key, Value value) { entries_[key()] = {stamp_, std::move(value)}; }
  /// Puts `value` there if there is none; true if so.
  bool insert(Key key, Value value = {}) {
    if (holds(key)) return false;
    set(key, std::move(value));
    return true;
  }

 private:
  struct Entry {
    std::uint32_t stamp = 0;  // of the use that set it
    [[no_unique_address]] Value value{};
  };
  std::vector<Entry> entries_;
  std::uint32_t stamp_ = 1;
};

template <class Key>
using StampedSet = StampedTable<Key, std::monostate>;

}  // namespace cutbench
