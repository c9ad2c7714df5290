#include "harness/mesh/mesh_format.h"

#include <algorithm>
#include <array>

namespace cutbench {

namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

/// The first word that is in no comment.
std::string_view first_word(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (!text.starts_with('#')) return text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  }
}

}  // namespace

std::string format_of(std::string_view text) {
  constexpr std::array obj_words{"v", "vt", "vn", "f", "l", "o", "g", "s", "mtllib", "usemtl"};
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.starts_with("# vtk DataFile")) return "VTK";
  const std::string_view word = first_word(text);
  if (word == "ply") return "PLY";
  if (word.ends_with("OFF") && word.find_first_not_of("STCN4n") == word.size() - 3) return "OFF";  // STOFF, COFF, ...
  if (word == "$MeshFormat") return "Gmsh";
  if (word == "<VTKFile") return "VTK";
  if (word == "solid" && text.find("facet") != std::string_view::npos) return "STL";
  if (std::find(obj_words.begin(), obj_words.end(), word) != obj_words.end()) return "OBJ";
  return "";
}

}  // namespace cutbench
