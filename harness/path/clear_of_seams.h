// Seams of an unrolled sheet lie where its unrolling put them, so a path may run along one, where a cut opens nothing.
// Such a sheet is unrolled anew, with its seams elsewhere.
#pragma once

#include <span>
#include <string>

#include "harness/path/pick.h"

namespace cutbench {

/// Unrolls `mesh` anew where it was unrolled, was never cut, and `path` runs along seams, as far as that can be helped.
/// \pre `mesh` passed check_and_repair(), and does again
/// \throw InputError: as curves_at_rest()
void clear_of_seams(MeshData& mesh, const std::string& mesh_name, std::span<const AnyCurve> path,
                    const std::string& path_name);

}  // namespace cutbench
