// Rest positions for a mesh whose rest shape is the mesh itself, as it lies in space: a tube, a cone, a patch of skin.
//
// It is unrolled triangle by triangle, each with its own lengths, and sewn where two neighbours don't meet in the plane
// (harness/mesh/seams.h). So every triangle has the rest shape that it has in space, whatever the curvature; the price
// of curvature in both directions is seams, one out of every vertex whose angles don't add up to 360 degrees. A tube
// has one seam, a cone one, a sphere one for nearly every vertex.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// Sides that meet in the plane within this share of their length do meet: what files with few digits leave open.
constexpr double unrolled_gap = 1e-3;

/// Gives `mesh` rest positions, and copies of the vertices on seams; a note says how many edges are seams. Triangles
/// come out counter-clockwise, also those of a side that a Moebius strip turns over. Parts that would cover each other
/// lie apart. O(n log n) for each part that is laid apart.
/// \pre `mesh.rest` is empty
/// \throw InputError, beginning with `name`: a corner beyond the vertices, an edge of three triangles, a triangle
/// without area, or more parts than `most_parts`
void unroll(MeshData& mesh, const std::string& name);

/// Edges of a file, as the numbers of their two vertices there, the lower one first.
using FileEdges = std::set<std::pair<std::int32_t, std::int32_t>>;

/// Unrolls anew a mesh that was unrolled and is not cut, so that none of `whole` is a seam; but where laying them side
/// by side would cover a part of the sheet, some stay seams. Triangles keep their order, and corners theirs.
/// \pre `mesh` passed check_and_repair(), and does again
void unroll_anew(MeshData& mesh, const std::string& name, const FileEdges& whole);

constexpr std::size_t most_parts = 1000;

}  // namespace cutbench
