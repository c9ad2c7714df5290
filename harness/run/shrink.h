// A smaller case that still fails.
#pragma once

#include <functional>
#include <vector>

#include "harness/cut/path.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

struct Specimen {
  MeshData mesh;
  std::vector<Curve> cuts;
};

/// Leaves out cuts, points or pieces of their curves, and triangles, for as long as still_fails() holds for what is
/// left: greedily, in ever smaller runs. Stops early when still_fails() says no to all, as it may when time is up.
/// \pre still_fails(specimen)
Specimen shrunk(Specimen specimen, const std::function<bool(const Specimen&)>& still_fails);

}  // namespace cutbench
