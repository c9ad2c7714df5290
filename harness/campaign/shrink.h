// A smaller case that still fails.
#pragma once

#include <functional>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/path/curve.h"

namespace cutbench {

/// A sheet, and cuts to be made in it one after the other.
struct CutCase {
  MeshData mesh;
  std::vector<Curve> cuts;
};

/// Leaves out cuts, points or pieces of their curves, and triangles, for as long as still_fails() holds for what is
/// left: greedily, in ever smaller runs. Stops early when still_fails() says no to all, as it may when time is up.
/// \pre still_fails(cut_case)
CutCase shrunk(CutCase cut_case, const std::function<bool(const CutCase&)>& still_fails);

}  // namespace cutbench
