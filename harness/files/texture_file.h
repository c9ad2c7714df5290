// Files of meshes that have texture coordinates beside their rest positions (harness/mesh/texture.h).
#pragma once

#include <filesystem>
#include <span>

#include "harness/files/whole_file.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/texture.h"

namespace cutbench {

/// Of the file that `read` was read from by `reading`. Empty where its `vt` are its rest positions, where some corner
/// has none, and where it is neither OBJ nor PLY.
Texture read_texture(const std::filesystem::path& path, const MeshReading& reading, const MeshData& read);

/// mesh_file() with the texture, if there is one: an OBJ has it as `vt` (textured_obj_text()). A VTU has it as
/// `texture_corners` of each triangle, six numbers, and as `texture` of each vertex where no vertex has several. An OFF
/// has none.
[[nodiscard]] WholeFile textured_file(const MeshData& mesh, const Texture& texture, const std::filesystem::path& path,
                                      std::span<const MeshColumn> columns = {});

}  // namespace cutbench
