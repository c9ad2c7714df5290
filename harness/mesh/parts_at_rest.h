// Which vertices of a MeshData hang together by its triangles.
#pragma once

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// Parts at rest: panels are apart, whatever is sewn. \pre corners are in range
inline UnionFind parts_at_rest(const MeshData& mesh) {
  UnionFind joined(mesh.rest.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    joined.join(to_size(a), to_size(b));
    joined.join(to_size(a), to_size(c));
  }
  return joined;
}

}  // namespace cutbench
