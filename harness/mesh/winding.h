// Which way round a file's triangles run. A sheet's run counter-clockwise at rest. In space a panel then has its other
// side up where its `vt` are mirrored, as those of a left sleeve laid over a right one: files keep their winding.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/parents.h"
#include "harness/mesh/texture.h"

namespace cutbench {

/// Which of the `clockwise` triangles are of a part that hangs together at rest and runs clockwise as a whole. All
/// others are faults of the file. \pre corners are in range
/// \param clockwise  per triangle
/// \return the same; empty: none is
std::vector<std::uint8_t> of_clockwise_parts(const MeshData& mesh, const std::vector<std::uint8_t>& clockwise);

/// Turns the triangles of a cut sheet, and their texture, back to how the file's run.
/// \param result   to_mesh_data() of `cut`
/// \param parents  of `cut`, before which the sheet was `read`
void wind_as_read(const MeshData& read, const Sheet& cut, const Parents& parents, MeshData& result, Texture& texture);

/// For a result that another program made of `read`, and that may be broken: turns its parts that run clockwise as a
/// whole, if `read` had such parts. What else runs clockwise stays so.
void turn_clockwise_parts(const MeshData& read, MeshData& result);

}  // namespace cutbench
