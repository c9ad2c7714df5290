// The [[cuts]] of a scene file, and what the rest of its reading shares with them.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "harness/scenes/toml_reader.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// Refuses each of `others` that is there.
void exclude(const TomlReader& reader, const char* present, std::initializer_list<const char*> others);
/// Three numbers of a place, an array in TOML. \param what  it is, for the error
Point3 read_place(const TomlReader& reader, const toml::array* numbers, const std::string& what);
/// Of the whole file, in their order. \param folder  of the scene  \param scale  lengths of path files times this are m
std::vector<Scene::Cut> read_cuts(const TomlReader& file, const std::filesystem::path& folder, double scale);

}  // namespace cutbench
