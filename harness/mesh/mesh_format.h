// What format a mesh file has by its text, whatever its name says.
#pragma once

#include <string>
#include <string_view>

namespace cutbench {

/// "OBJ", "OFF", "PLY", "STL", "Gmsh" or "VTK"; empty where nothing is sure.
std::string format_of(std::string_view text);

}  // namespace cutbench
