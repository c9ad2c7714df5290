// What the parts of a cut sheet were before the cuts: for whoever carries data of vertices and triangles through them.
#pragma once

#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// A vertex of the opened sheet before the cuts, and its part in one after them.
struct VertexPart {
  DeformedIndex vertex;
  double weight;
};

struct Parents {
  /// Per slot of a deformed vertex: one to three vertices of one old triangle, on the same side of every incision that
  /// there was, and its barycentric coordinates among them, which add up to 1. One where it lies on an old vertex, two
  /// where it lies on an old edge, but for the rounding of a crossing; both lips of a new incision have the same.
  /// Coordinates are negative only where a method moved the border outwards. Empty where the slot is free.
  std::vector<std::vector<VertexPart>> vertices;
  /// Per slot of a triangle: the old one that holds its centroid in rest space. Invalid where the slot is free.
  std::vector<TriangleIndex> triangles;
};

/// \pre `cut` is a copy of `before` that was cut any number of times; no slot of it has moved (Sheet::compact()).
/// Looks at the whole sheet.
Parents parents_of(const Sheet& before, const Sheet& cut);

}  // namespace cutbench
