// Vertices of a file at which fans of triangles meet in a point at rest, while seams join the fans in space: the tip of
// an incision that ends on a seam.
#pragma once

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// Each such fan gets a vertex of its own. Fans that meet in a point in space, too, are left as they are.
/// \pre `mesh` has rest positions; a corner may be out of range
void part_fans_at_seams(MeshData& mesh);

}  // namespace cutbench
