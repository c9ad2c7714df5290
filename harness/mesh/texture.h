// The texture coordinates of a mesh whose `vt` are not its rest positions, carried over cuts.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/parents.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

/// Per triangle of a MeshData, the coordinates at its corners: they differ between two triangles at a vertex where the
/// texture has a seam. Empty: no texture.
using Texture = std::vector<std::array<Point2, 3>>;

/// The first line of an OBJ that has both: `vt` are the texture, and lines of comments the rest positions. `#vr x y` is
/// one of them, and `#fr a b c` says which three the face above has, counted from 1. textured_obj_text() writes it.
constexpr std::string_view vt_are_texture = "# vt: texture; #vr, #fr: rest positions";

/// Of the OBJ file `text`, which `read` was read from by the same `reading`. Empty where the `vt` are the rest
/// positions, where some corner has none, and where one is not finite.
Texture read_obj_texture(std::string_view text, const std::string& name, const MeshReading& reading,
                         const MeshData& read);
/// The same of a PLY whose vertices have texture coordinates.
Texture read_ply_texture(const std::string& text, const std::string& name, const MeshReading& reading,
                         const MeshData& read);
/// read_obj() gives back mesh and texture, bit for bit.
std::string textured_obj_text(const MeshData& mesh, const Texture& texture);

/// That of the cut sheet, by its parents' weights: linear in every old triangle. On a seam each triangle has the
/// coordinates of the side that holds its centroid. Where a triangle lies over a seam, as a method that moves vertices
/// may leave it, its side goes on linearly beyond the seam.
/// \param texture  of `before`, in the order of to_mesh_data()
/// \pre `parents` are those of the two sheets
Texture carried_over(const Texture& texture, const Sheet& before, const Sheet& cut, const Parents& parents);
/// The vertices' own coordinates, in the order of to_mesh_data(). Empty where one has several.
std::vector<Point2> texture_of_vertices(const MeshData& mesh, const Texture& texture);

}  // namespace cutbench
