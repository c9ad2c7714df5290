// Meshes as the text of their files, formats as harness/files/mesh_file.h says.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

/// The mesh in the OBJ file `text`, unchecked: indices are in range, all else is left to check_and_repair. `rest` is
/// empty where no face has a `vt`, and where `vt` are not taken (rest_choice.h). Those of a file that begins with
/// vt_are_rest are, but by RestFrom::plane. `name` begins every note and error.
/// `as_is`: the file is to be judged, so numbers that aren't finite stay, and a corner that doesn't exist becomes an
/// index out of range.
/// \throw InputError with the line's number; RestFrom::vt and no `vt`, but as is.
MeshData read_obj(std::string_view text, const std::string& name, bool as_is = false, const MeshReading& reading = {});

/// The same of an OFF or a PLY, text or binary. An index that 32 bits don't hold becomes -1. `rest` is empty; that of a
/// PLY whose vertices have texture coordinates (s and t, u and v) as that of an OBJ with `vt`.
/// \throw InputError beginning with `name`: cut short or not of the format, a face that isn't a triangle.
MeshData read_off(const std::string& text, const std::string& name, bool triangulated = false);
MeshData read_ply(const std::string& text, const std::string& name, const MeshReading& reading = {});

/// The first line of an OBJ that says so itself; obj_text() writes it.
constexpr std::string_view vt_are_rest = "# vt: rest positions";

/// Per triangle, the number of its piece, from 0 in order of the first triangle: triangles that share a vertex, or
/// vertices that are sewn together, are of one piece.
std::vector<std::int32_t> pieces_of(const MeshData& mesh);

/// What a VTU says of each vertex or triangle, or of none of them, beside what it always does.
struct MeshColumn {
  enum class Of { vertices, triangles, sheet };
  std::string name;
  Of of;
  bool whole;  ///< integers
  int components;
  std::vector<double> values;  ///< those of the first vertex or triangle, those of the second, ...
};

/// The lines `v` of an OBJ, and for each vertex the number of its own, from 1: sewn vertices have one.
struct ObjPoints {
  std::string lines;
  std::vector<std::size_t> number;
};
ObjPoints obj_points(const MeshData& mesh);

/// Numbers with the fewest digits that read back bit for bit.
std::string obj_text(const MeshData& mesh);
std::string off_text(const MeshData& mesh);  ///< the deformed positions alone
std::string vtu_text(const MeshData& mesh, std::span<const MeshColumn> columns);

}  // namespace cutbench
