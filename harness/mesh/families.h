// The sheets of the experiments: four ways to fill the unit square with 2 n^2 triangles.
#pragma once

#include <span>
#include <string>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// The names make_sheet knows:
/// - `grid`: n x n squares, every diagonal from lower left to upper right, as in the paper. All aspect ratios 2.
/// - `alternating`: the same squares, diagonals rising and falling in turns like a checkerboard's colours.
/// - `delaunay`: Delaunay triangulation of 4 n points evenly spaced on the border and (n-1)^2 Poisson-disc points,
///   moved twice to the centroids of their triangles. Seed 1 for every n. Interior points are numbered row by row.
/// - `graded`: the grid with the other diagonals, drawn towards the corner (0, 0): the square roots of the areas of the
///   largest and the smallest triangle are as 9 to 1 (n = 20) to 11 to 1 (n = 80).
std::span<const char* const> sheet_families();

/// Flat sheet, rest = deformed's x and y, z = 0. Exactly 2 n^2 triangles and (n+1)^2 vertices; border coordinates are
/// exactly 0 or 1 where they should be. The same bits on every machine.
/// \pre 1 <= n <= 2000
/// \throw InputError for an unknown family or n out of range.
MeshData make_sheet(const std::string& family, int n);

/// n of the n x n squares that make `triangles`; throws InputError unless there is one, and not too large.
int squares_per_side(std::int64_t triangles);

}  // namespace cutbench
