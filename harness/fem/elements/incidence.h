// Which elements meet at each vertex, kept up to date cut by cut.
#pragma once

#include <span>

#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/elements/element_table.h"

namespace cutbench {

class Incidence {
 public:
  /// A corner of an element: 4 element + corner, as half-edges are numbered.
  using Corner = HalfEdge;

  void resize(std::size_t vertices) { corners_.resize(vertices); }
  void reserve_spare() { corners_.reserve_spare(); }
  std::span<const Corner> at(std::size_t vertex) const { return corners_[vertex]; }
  void add(const Element& element, std::size_t number);
  /// \pre the element is there.
  void remove(const std::array<DeformedIndex, 3>& vertices, std::size_t number);

 private:
  GrowingRows<Corner> corners_;  // per vertex
};

}  // namespace cutbench
