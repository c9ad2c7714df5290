// What the parts of a cut sheet were before the cut: for whoever carries data of vertices and triangles through it.
#pragma once

#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// A vertex of the opened sheet before the cut, and its part in one after it.
struct VertexPart {
  DeformedIndex vertex;
  double weight;
};

/// Per slot of a deformed vertex, the vertices before the last cut (since Sheet::begin_cut()) whose positions, times
/// the weights, add up to its own, in rest space and deformed; the weights add up to 1. An old vertex that did not move
/// is itself, with weight 1. Empty where the slot is free.
std::vector<std::vector<VertexPart>> vertex_parents(const Sheet& cut);

/// Per slot of a triangle, the triangle of `before` that holds its centroid in rest space; itself where the last cut
/// did not touch it. Invalid where the slot is free. \pre `cut` is a copy of `before`, cut once. Cost: new triangles
/// times triangles they replace.
std::vector<TriangleIndex> triangle_parents(const Sheet& before, const Sheet& cut);

}  // namespace cutbench
