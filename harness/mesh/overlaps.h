// Two parts of a mesh that cover the same place at rest.
#pragma once

#include <optional>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

struct Overlap {
  std::size_t low, high;  ///< triangles, from 0
  Point2 near;            ///< on the border of one of them
};

/// An overlap thinner than this is none, in diagonals of the sheet: borders that meet with rounded coordinates.
constexpr double overlap_tolerance = 1e-9;

/// The overlap of the first border edge that has one, or none. Where two parts overlap, the border of one of them runs
/// through the other or along it: only border edges are looked at. O(n log n), exact where borders coincide.
/// \pre all triangles are strictly counter-clockwise at rest, and at most one lies on each side of an edge
std::optional<Overlap> find_overlap(const MeshData& mesh);

}  // namespace cutbench
