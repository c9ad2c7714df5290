// The OBJ part of read_mesh.
#pragma once

#include <string>
#include <string_view>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

/// The mesh in the OBJ file `text`, unchecked: indices are in range, all else is left to check_and_repair. `rest` is
/// empty where no face has a `vt`. `name` begins every note and error.
/// `as_is`: the file is to be judged, so numbers that aren't finite stay, and a corner that doesn't exist becomes an
/// index out of range.
/// \throw InputError with the line's number.
MeshData read_obj(std::string_view text, const std::string& name, bool as_is = false);

}  // namespace cutbench
