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

/// Leaves out cuts, points or pieces of their curves, and triangles, greedily and in ever smaller runs, as long as
/// still_fails() holds for the rest. To stop early, for example when time is up, still_fails() returns false.
/// \pre still_fails(cut_case)
CutCase shrunk(CutCase cut_case, const std::function<bool(const CutCase&)>& still_fails);

}  // namespace cutbench
