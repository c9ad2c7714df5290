#include "harness/files/mesh_file.h"

#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <string>

#include "harness/mesh/mesh_format.h"
#include "harness/mesh/sew.h"
#include "harness/mesh/texture.h"

namespace cutbench {

namespace {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

void check_format(const std::string& text, const std::string& name, const std::string& extension) {
  const std::string format = format_of(text);
  if (format == "OBJ" || format == "OFF" || format == "PLY") {
    const std::string its_own = format == "OBJ" ? ".obj" : format == "OFF" ? ".off" : ".ply";
    if (extension != its_own)
      throw InputError(name + ": by its text it is of the format " + format + "; rename it to " + its_own);
  } else if (!format.empty()) {
    throw InputError(name + ": by its text it is of the format " + format +
                     "; convert it to .obj, .off or .ply, as `meshio convert` does");
  }
}

MeshData read_unchecked(const std::filesystem::path& path, bool as_is, const MeshReading& reading) {
  const std::string name = path.filename().string();
  const std::string extension = lower_case_extension(path);
  if (extension != ".obj" && extension != ".off" && extension != ".ply")
    throw InputError(name + ": unknown mesh format; use .obj, .off or .ply, as `meshio convert` writes them");

  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || access(path.c_str(), R_OK) != 0)
    throw InputError(path.string() + ": no such file, or it can't be read; check the path");
  const std::string text = text_of(path);
  check_format(text, name, extension);
  if (extension == ".obj") return read_obj(text, name, as_is, reading);
  MeshData mesh = extension == ".off" ? read_off(text, name, reading.triangulate) : read_ply(text, name, reading);
  if (reading.rest == RestFrom::vt && mesh.rest.empty() && !as_is)
    throw InputError(name + ": no vt, so they can't be the rest positions; leave --rest vt out");
  return mesh;
}

void check_extension(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".obj" && extension != ".off" && extension != ".vtu")
    throw InputError(path.string() + ": unknown mesh format; use .obj, .off or .vtu");
}

}  // namespace

MeshData read_mesh(const std::filesystem::path& path, const MeshReading& reading) {
  MeshData mesh = read_unchecked(path, false, reading);
  const std::string name = path.filename().string();
  const bool of_vt = !mesh.rest.empty();
  if (!of_vt && reading.sew) weld_in_space(mesh, *reading.sew, !lies_in_space(mesh, reading.rest), name);
  if (!of_vt && !mesh.triangles.empty()) take_rest(mesh, name, reading.rest);
  check_and_repair(mesh, name, of_vt);
  if (of_vt && reading.sew) sew(mesh, *reading.sew, name);
  // In a plane, what lies at one place in space does so at rest.
  if (const Unsewn open = of_vt || mesh.unrolled ? unsewn(mesh) : Unsewn{}; open.count > 0) {
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.0e", open.distance * 1.5);
    mesh.notes.push_back(name +
                         ": vertices that lie where others do, though apart at rest: " + std::to_string(open.count) +
                         "; the sheet is open there, --sew " + (open.distance > 0 ? distance : "0") + " sews it");
  }
  return mesh;
}

bool leaves_vt(const std::filesystem::path& path, const MeshReading& reading) {
  if (lower_case_extension(path) != ".obj") return false;
  if (text_of(path).starts_with(vt_are_texture)) return true;
  if (!read_unchecked(path, true, reading).rest.empty()) return false;
  try {
    return !read_unchecked(path, true, {RestFrom::vt, reading.triangulate}).rest.empty();
  } catch (const InputError&) {  // some corners have one
    return true;
  }
}

MeshData read_mesh_as_is(const std::filesystem::path& path, const MeshReading& reading) {
  const std::string name = path.filename().string();
  MeshData mesh = read_unchecked(path, true, reading);
  if (mesh.triangles.empty()) throw InputError(name + ": no triangles; the file is empty, cut short or holds no mesh");
  if (mesh.rest.empty()) take_rest_from_plane(mesh, name);
  return mesh;
}

void check_mesh_place(const std::filesystem::path& path, const std::string& what) {
  check_extension(path);
  check_writable(path, what);
}

WholeFile mesh_file(const MeshData& mesh, const std::filesystem::path& path, std::span<const MeshColumn> columns) {
  check_extension(path);
  const std::string extension = path.extension().string();
  if (extension == ".obj") return {path, obj_text(mesh)};
  if (extension == ".off") return {path, off_text(mesh)};
  return {path, vtu_text(mesh, columns)};
}

void write_mesh(const MeshData& mesh, const std::filesystem::path& path) { mesh_file(mesh, path).place(); }

}  // namespace cutbench
