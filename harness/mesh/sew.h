// Vertices that a file has twice where two panels meet, as some programs write them: sewn on request.
#pragma once

#include <string>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// Vertices of the border that are no farther from each other in space than `tolerance` become one point of the sheet
/// (MeshData::sewn), unless they are at bit-equal places at rest: those are the lips of an incision. A note says how
/// many. \pre `mesh` has rest positions, and passed check_and_repair(). O(n log n)
void sew(MeshData& mesh, double tolerance, const std::string& name);

/// The same of a mesh without rest positions, whose rest shape is the mesh itself: such vertices become one, and the
/// first one stays.
void weld_in_space(MeshData& mesh, double tolerance, const std::string& name);

/// Vertices of the border that lie exactly where another one does, though apart at rest, and are not sewn to it.
std::size_t unsewn(const MeshData& mesh);

}  // namespace cutbench
