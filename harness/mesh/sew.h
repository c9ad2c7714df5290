// Vertices that a file has twice where two panels meet, as some programs write them: sewn on request.
#pragma once

#include <string>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// Vertices of the border that are no farther from each other in space than `tolerance` become one point of the sheet
/// (MeshData::sewn), unless they are at bit-equal places at rest: those are the lips of an incision. A note says how
/// many. \pre `mesh` has rest positions, and passed check_and_repair(). O(n log n)
void sew(MeshData& mesh, double tolerance, const std::string& name);

/// The same of a mesh without rest positions: such vertices become one, and the first one stays.
/// \param in_plane  it will be at rest in the plane that it lies in: there two borders at bit-equal places are an
///     incision, which stays, and a note says so. Else it is at rest as it is in space
void weld_in_space(MeshData& mesh, double tolerance, bool in_plane, const std::string& name);

/// Vertices of the border that lie where another one does, though apart at rest, and are not sewn to it.
struct Unsewn {
  std::size_t count = 0;
  double distance = 0;  ///< the largest between two such, no more than the last of a file's six digits
};
Unsewn unsewn(const MeshData& mesh);

}  // namespace cutbench
