#include "harness/fem/incidence.h"

#include <algorithm>

namespace cutbench {

void Incidence::add(const Element& element, std::size_t number) {
  for (int k = 0; k < 3; ++k) {
    Row& row = rows_[element.vertex[static_cast<std::size_t>(k)]()];
    if (row.size == row.capacity) {  // moves to the end, with room for as many again
      const std::uint32_t capacity = std::max<std::uint32_t>(8, 2 * row.capacity);
      const auto begin = static_cast<std::uint32_t>(corners_.size());
      corners_.resize(corners_.size() + capacity);
      std::copy_n(corners_.begin() + row.begin, row.size, corners_.begin() + begin);
      row.begin = begin, row.capacity = capacity;
    }
    corners_[row.begin + row.size++] = half_edge(TriangleIndex(number), k);
  }
}

void Incidence::remove(const std::array<DeformedIndex, 3>& vertices, std::size_t number) {
  for (int k = 0; k < 3; ++k) {
    Row& row = rows_[vertices[static_cast<std::size_t>(k)]()];
    const auto begin = corners_.begin() + row.begin, end = begin + row.size;
    const auto here = std::find(begin, end, half_edge(TriangleIndex(number), k));
    std::copy(here + 1, end, here);  // the others keep their order
    --row.size;
  }
}

}  // namespace cutbench
