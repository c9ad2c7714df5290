// The case files of tests/cases/catalogue (README.md there explains the format): reading them, and nothing else.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/path/curve.h"

namespace cutbench {

/// One sheet and its cuts, as the library would get them from files: neither is read or checked yet.
struct CatalogueMember {
  std::string label;             ///< what tells it from the others of its file; empty where it is the only one
  nlohmann::json sheet;          ///< a file, a family or the arrays themselves
  std::string path_text;         ///< of the path file
  double scale = 1, offset = 0;  ///< of the sheet; the path has them already
};

struct CatalogueCase {
  std::string name, about, source;
  double chord_tolerance;   ///< NaN: not given
  std::vector<int> rounds;  ///< of the local split: 0, 1 and 3 where the file does not say
  std::vector<CatalogueMember> members;
  nlohmann::json expect;

  /// What is expected of one method: `expect` with what its `methods` says of this one.
  nlohmann::json expect_of(const std::string& method) const;
};

/// The names of all files, without the extension, in order. Opens none: every test program asks for them when it
/// starts.
std::vector<std::string> catalogue_names();
/// Throws InputError that names the file: unknown keys, no `about`, ...
CatalogueCase read_catalogue_case(const std::string& name);

/// As read_mesh() and read_path() read them. Throw InputError.
MeshData sheet_of(const CatalogueMember& member);
std::vector<Curve> cuts_of(const CatalogueMember& member);

}  // namespace cutbench
