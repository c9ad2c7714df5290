// Slots of a sheet's vertices and triangles, and their rows where the free ones are left out.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// The rows that Sheet::to_mesh_data() gives. Cost: the whole sheet.
struct RowNumbers {
  explicit RowNumbers(const Sheet& sheet) : vertex(sheet.deformed_slots(), -1), triangle(sheet.triangle_slots(), -1) {
    for (std::size_t d = 0; d < vertex.size(); ++d)
      if (sheet.rest_vertex(DeformedIndex(d)).valid()) vertex[d] = vertices++;
    for (std::size_t t = 0; t < triangle.size(); ++t)
      if (sheet.triangle(TriangleIndex(t)).alive()) triangle[t] = triangles++;
  }
  /// Of a vertex, or of a phantom node: those come after the vertices.
  std::int32_t of(DeformedIndex d) const {
    return d() < vertex.size() ? vertex[d()] : vertices + to_int32(d() - vertex.size());
  }

  std::vector<std::int32_t> vertex, triangle;  ///< per slot; -1 where it is free
  std::int32_t vertices = 0, triangles = 0;
};

}  // namespace cutbench
