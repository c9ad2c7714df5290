// Which way round a file's triangles run. A sheet's run counter-clockwise at rest. In space a panel then has its other
// side up where its `vt` are mirrored, as those of a left sleeve laid over a right one: files keep their winding.
#pragma once

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/parents.h"
#include "harness/mesh/texture.h"

namespace cutbench {

/// Makes all triangles counter-clockwise at rest. Parts that hang together at rest and run clockwise as a whole are
/// noted in MeshData::clockwise; single triangles that do are faults. \pre corners are in range, no triangle is flat
/// \return how many were turned
std::size_t turn_clockwise_triangles(MeshData& mesh);

/// Turns the triangles of a cut sheet, and their texture, back to how the file's run.
/// \param result   to_mesh_data() of `cut`
/// \param parents  of `cut`, before which the sheet was `read`
void wind_as_read(const MeshData& read, const Sheet& cut, const Parents& parents, MeshData& result, Texture& texture);

/// For a result that another program made of `read`, and that may be broken: turns its parts that run clockwise as a
/// whole, if `read` had such parts. What else runs clockwise stays so.
void turn_clockwise_parts(const MeshData& read, MeshData& result);

}  // namespace cutbench
