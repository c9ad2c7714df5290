// Pairs half-edges by their end vertices: a small hash table that is emptied in constant time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

class EdgeTable {
 public:
  /// Empties the table and makes room for `n` edges.
  void reset(std::size_t n) {
    const std::size_t capacity = std::bit_ceil(2 * n + 2);
    if (capacity > entries_.size()) {
      entries_.assign(capacity, {});
      round_ = 0;
      shift_ = 64 - std::countr_zero(capacity);
    }
    ++round_;
  }

  /// The half-edge put in earlier for the edge {a, b}, which is then forgotten; else puts `h` in and returns none.
  HalfEdge pair_or_insert(VertexIndex a, VertexIndex b, HalfEdge h) {
    const auto [low, high] = std::minmax(a.value, b.value);
    const std::uint64_t key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
    for (std::size_t i = (key * 0x9E3779B97F4A7C15u) >> shift_;; i = (i + 1) & (entries_.size() - 1)) {
      Entry& e = entries_[i];
      if (e.round != round_) {
        e = {key, round_, h};
        return {};
      }
      if (e.key == key && e.half_edge.valid()) return std::exchange(e.half_edge, HalfEdge());
    }
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t round = 0;
    HalfEdge half_edge;
  };
  std::vector<Entry> entries_;
  std::uint32_t round_ = 0;
  int shift_ = 64;
};

}  // namespace cutbench
