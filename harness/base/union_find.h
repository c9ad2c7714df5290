// Classes of numbers that are joined pair by pair (union-find, Galler and Fischer 1964).
//
// The oracle (harness/measure) has one of its own: it shares no code with what it judges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace cutbench {

class UnionFind {
 public:
  /// 0 ... n-1, each in a class of its own.
  explicit UnionFind(std::size_t n = 0) { reset(n); }
  void reset(std::size_t n) {
    parent_.resize(n), size_.assign(n, 1);
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest number of the class.
  std::int32_t find(std::int32_t i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a), b = find(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    parent(b) = a;
    size_[static_cast<std::size_t>(a)] += size_[static_cast<std::size_t>(b)];
  }
  /// How many numbers the class of i has.
  std::int32_t size(std::int32_t i) { return size_[static_cast<std::size_t>(find(i))]; }

 private:
  std::int32_t& parent(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<std::int32_t> parent_, size_;  // size: of a class, at its smallest number
};

}  // namespace cutbench
