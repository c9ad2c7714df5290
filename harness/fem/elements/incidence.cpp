#include "harness/fem/elements/incidence.h"

#include "harness/base/conversions.h"

namespace cutbench {

void Incidence::add(const Element& element, std::size_t number) {
  for (int k = 0; k < 3; ++k) corners_.append(element.vertex[to_size(k)](), half_edge(TriangleIndex(number), k));
}

void Incidence::remove(const std::array<DeformedIndex, 3>& vertices, std::size_t number) {
  for (int k = 0; k < 3; ++k) corners_.erase(vertices[to_size(k)](), half_edge(TriangleIndex(number), k));
}

}  // namespace cutbench
