// Which elements meet at each vertex, kept up to date cut by cut.
#pragma once

#include <span>
#include <vector>

#include "harness/fem/element_table.h"

namespace cutbench {

class Incidence {
 public:
  /// A corner of an element: 4 element + corner, as half-edges are numbered.
  using Corner = HalfEdge;

  void resize(std::size_t vertices) { rows_.resize(vertices); }
  void reserve_spare() {
    rows_.reserve(rows_.size() + rows_.size() / 2), corners_.reserve(corners_.size() + corners_.size() / 2);
  }
  std::span<const Corner> at(std::size_t vertex) const {
    return {corners_.data() + rows_[vertex].begin, rows_[vertex].size};
  }
  void add(const Element& element, std::size_t number);
  /// \pre the element is there.
  void remove(const std::array<DeformedIndex, 3>& vertices, std::size_t number);

 private:
  struct Row {
    std::uint32_t begin = 0, size = 0, capacity = 0;
  };
  std::vector<Row> rows_;
  std::vector<Corner> corners_;
};

}  // namespace cutbench
