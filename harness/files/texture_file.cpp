#include "harness/files/texture_file.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "harness/files/mesh_file.h"

namespace cutbench {

namespace {

std::vector<MeshColumn> with_texture(const MeshData& mesh, const Texture& texture, std::span<const MeshColumn> others) {
  std::vector<MeshColumn> columns(others.begin(), others.end());
  MeshColumn corners{"texture_corners", MeshColumn::Of::triangles, false, 6, {}};
  for (const auto& triangle : texture)
    for (const Point2 p : triangle) corners.values.insert(corners.values.end(), {p.x, p.y});
  columns.push_back(std::move(corners));
  MeshColumn vertices{"texture", MeshColumn::Of::vertices, false, 2, {}};
  for (const Point2 p : texture_of_vertices(mesh, texture)) vertices.values.insert(vertices.values.end(), {p.x, p.y});
  if (!vertices.values.empty()) columns.push_back(std::move(vertices));
  return columns;
}

}  // namespace

Texture read_texture(const std::filesystem::path& path, const MeshReading& reading, const MeshData& read) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return read_ply_texture(text_of(path), path.filename().string(), reading, read);
  if (extension != ".obj") return {};
  return read_obj_texture(text_of(path), path.filename().string(), reading, read);
}

WholeFile textured_file(const MeshData& mesh, const Texture& texture, const std::filesystem::path& path,
                        std::span<const MeshColumn> columns) {
  if (texture.empty()) return mesh_file(mesh, path, columns);
  if (path.extension() == ".obj") return {path, textured_obj_text(mesh, texture)};
  return mesh_file(mesh, path, with_texture(mesh, texture, columns));
}

}  // namespace cutbench
