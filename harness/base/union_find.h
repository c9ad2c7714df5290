// Classes of numbers that are joined pair by pair (union-find, Galler and Fischer 1964).
//
// The oracle (harness/oracle) has one of its own: it shares no code with what it judges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace cutbench {

class UnionFind {
 public:
  /// 0 ... n-1, each in a class of its own. \pre n < 2^32
  explicit UnionFind(std::size_t n = 0) { reset(n); }
  void reset(std::size_t n) {
    parent_.resize(n);
    size_.assign(n, 1);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The smallest number of the class.
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    parent_[b] = static_cast<std::uint32_t>(a);
    size_[a] += size_[b];
  }
  /// How many numbers the class of i has.
  std::size_t size(std::size_t i) { return size_[find(i)]; }

 private:
  std::vector<std::uint32_t> parent_, size_;  // size: of a class, at its smallest number
};

}  // namespace cutbench
