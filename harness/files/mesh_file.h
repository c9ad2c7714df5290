// Mesh files: read through the checks of harness/mesh/check_and_repair.h, and written.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "harness/files/whole_file.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

/// Reads a triangle mesh by its extension (.obj, .off, .ply; upper case too) and passes it through check_and_repair.
///
/// OBJ: `v`, `vt` and `f` (v, v/vt, v//vn, v/vt/vn, negative indices), continued lines; other keywords are ignored. A
/// `v` used with several different `vt` becomes as many vertices, the first keeping its number. OFF, PLY: CGAL's
/// readers, text or binary; colours and normals are ignored. Texture coordinates of a PLY's vertices are its `vt`.
///
/// Rest positions are the `vt` or the plane the mesh lies in, as `reading` and harness/mesh/rest_choice.h say;
/// without `vt` see check_and_repair. `vt` that are not taken are left to read_texture(), with a note. Positions are
/// taken as written, without a unit.
/// \throw InputError naming the file, the element (counted from 1; lines in an OBJ) and what to do: no such file,
/// unknown extension, a text of another format, cut short or not of its format, faces that aren't triangles, and all
/// that check_and_repair refuses.
MeshData read_mesh(const std::filesystem::path& path, const MeshReading& reading = {});

/// An OBJ whose `vt` are not its rest positions.
bool leaves_vt(const std::filesystem::path& path, const MeshReading& reading);

/// Reads a mesh that somebody is to judge: nothing is repaired, refused or merged that a list of triangles can hold, so
/// indices may be out of range and coordinates NaN (in an OBJ; CGAL's readers refuse such files themselves). Rest
/// positions are the `vt` where there are any, or as `reading` says, of the vertices that triangles have and that are
/// finite.
/// \throw InputError as above for what can't be read as triangles at all, for no triangles, and a curved mesh without
/// rest positions.
MeshData read_mesh_as_is(const std::filesystem::path& path, const MeshReading& reading = {RestFrom::vt, false});

/// Writes by extension (lower case), numbers with the fewest digits that read back bit for bit (17 at most):
/// - .obj: `v` deformed, `vt` rest, one per vertex, `f v/vt`; read_mesh gives it back unchanged.
/// - .off: the deformed positions alone.
/// - .vtu: text; points deformed, point data `rest` (z = 0), cell data `piece` (connected component, from 0 in order of
///   the first triangle), `aspect_ratio` (of the rest triangle) and `strain` (the largest |principal stretch - 1|).
///
/// The file appears whole or not at all, see whole_file.h.
/// \throw InputError for an unknown extension, OutputError for a place that can't be written.
void write_mesh(const MeshData& mesh, const std::filesystem::path& path);

/// The same in two steps: the file is in its place after place(). \param columns  what a .vtu has beside the above
[[nodiscard]] WholeFile mesh_file(const MeshData& mesh, const std::filesystem::path& path,
                                  std::span<const MeshColumn> columns = {});

/// Says before the work what is wrong with a place to write a mesh to. `what` begins the error.
/// \throw InputError
void check_mesh_place(const std::filesystem::path& path, const std::string& what);

}  // namespace cutbench
