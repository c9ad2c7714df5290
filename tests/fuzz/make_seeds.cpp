// Turns the catalogue and the bad meshes into inputs of fuzz_cut. usage: cutbench_fuzz_seeds FOLDER
// The folder is emptied before, so that a run of the fuzzer that begins with it can be repeated.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "harness/files/mesh_file.h"
#include "tests/catalogue.h"

namespace {

namespace fs = std::filesystem;
using namespace cutbench;

void add_catalogue(const fs::path& folder) {
  for (const std::string& name : catalogue_names()) {
    const CatalogueCase c = read_catalogue_case(name);
    for (const CatalogueMember& member : c.members) {
      const fs::path file = folder / (name + " " + member.label + ".off");
      try {
        write_mesh(sheet_of(member), file);
      } catch (const InputError&) {  // its sheet is a bad one
        continue;
      }
      std::ofstream(file, std::ios::app) << member.path_text;
    }
  }
}

void add_bad_meshes(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(CUTBENCH_TEST_CASES "/bad_meshes")) {
    const fs::path file = folder / entry.path().filename();
    fs::copy_file(entry.path(), file);
    std::ofstream(file, std::ios::app) << R"({"cuts": [{"polyline": [[-1, 0.5], [2, 0.5]]}]})";
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: cutbench_fuzz_seeds FOLDER\n", 2;
  const fs::path folder = argv[1];
  fs::remove_all(folder);
  fs::create_directories(folder);
  add_catalogue(folder);
  add_bad_meshes(folder);
}
