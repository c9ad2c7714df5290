// Cuts a sheet by the library alone. usage: cut_alone sheet.obj path.json method > cut.obj
#include <cutbench/cut/cut_all.h>
#include <cutbench/mesh/check_and_repair.h>
#include <cutbench/mesh/mesh_text.h>
#include <cutbench/methods/registry.h>
#include <cutbench/path/path_text.h>

#include <fstream>
#include <iostream>
#include <iterator>

namespace {

std::string text_of(const char* file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int, char** argv) {
  using namespace cutbench;
  MeshData mesh = read_obj(text_of(argv[1]), argv[1]);
  check_and_repair(mesh, argv[1]);
  Sheet sheet(mesh);
  Locator locator(sheet);
  Cutter cutter;
  const MethodRow& row = find_method(argv[3]);
  const auto method = row.make(row.parameter.value);
  const CutRun run = cut_all(sheet, locator, cutter, read_path_text(text_of(argv[2]), argv[2]), *method, {});
  std::cout << obj_text(sheet.to_mesh_data());
  return run.status == Status::ok ? 0 : 1;
}
