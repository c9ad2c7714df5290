// A finer sheet of the same shape.
#pragma once

#include "harness/mesh/mesh_data.h"

namespace cutbench::live {

/// Every triangle becomes four, so that all vertices stay, and what is sewn stays sewn.
MeshData divided_in_four(const MeshData& coarse);

}  // namespace cutbench::live
