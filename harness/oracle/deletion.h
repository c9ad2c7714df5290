// What may be gone of a sheet whose cut takes triangles out: those that the path crosses, and nothing else.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// Triangles by number; all empty where a deletion is right.
struct Deletion {
  std::vector<int> invented;  ///< of the result, but with the same corners not of the input
  std::vector<int> unasked;   ///< of the input, gone though the path keeps farther than `near` from them
  std::vector<int> left;      ///< of the result, though the path is inside them and deeper than `near`
};

/// \param path  the requested curves, flattened, near the sheet
/// \param near  rest units, >= 0. Precondition: indices in range, no coordinate NaN or infinite.
Deletion judge_deletion(const Mesh& before, const Mesh& after, const std::vector<Segment>& path, double near);

}  // namespace cutbench::oracle
