#include "harness/mesh/seam_fans.h"

#include <map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"

namespace cutbench {

void part_fans_at_seams(MeshData& mesh) {
  if (mesh.sewn.empty()) return;
  const auto vertex = [&](std::size_t c) { return mesh.triangles[c / 3][c % 3]; };
  const auto point = [&](std::size_t c) { return mesh.sewn[to_size(vertex(c))]; };
  std::vector<int> vertices(mesh.rest.size(), 0);  // per point
  for (const std::int32_t v : mesh.sewn) ++vertices[to_size(v)];

  std::vector<std::size_t> corners;  // at points on seams
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    if (vertex(c) < 0 || vertex(c) >= std::ssize(mesh.rest)) return;
    if (vertices[to_size(point(c))] > 1) corners.push_back(c);
  }
  UnionFind at_rest(3 * mesh.triangles.size()), in_space(3 * mesh.triangles.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> edge_at_rest, edge_in_space;  // its first corner
  for (const std::size_t c : corners)
    for (const std::size_t steps : {1, 2}) {
      const std::size_t other = (c % 3 + steps) % 3 + c - c % 3;
      at_rest.join(c, edge_at_rest.try_emplace({vertex(c), vertex(other)}, c).first->second);
      in_space.join(c, edge_in_space.try_emplace({point(c), point(other)}, c).first->second);
    }
  std::map<std::int32_t, std::size_t> fan_of_point, fan_of_vertex;
  std::vector<char> meets_in_point(mesh.rest.size(), 0);
  for (const std::size_t c : corners)
    if (fan_of_point.try_emplace(point(c), in_space.find(c)).first->second != in_space.find(c))
      meets_in_point[to_size(point(c))] = 1;
  std::map<std::size_t, std::int32_t> number;  // per fan at rest: its vertex
  for (const std::size_t c : corners) {
    const std::int32_t v = vertex(c);
    if (meets_in_point[to_size(point(c))] != 0) continue;
    const std::size_t fan = at_rest.find(c);
    if (fan_of_vertex.try_emplace(v, fan).first->second == fan) continue;
    const auto [own, is_new] = number.try_emplace(fan, to_int32(mesh.rest.size()));
    if (is_new) {
      mesh.rest.push_back(Point2(mesh.rest[to_size(v)]));
      mesh.deformed.push_back(Point3(mesh.deformed[to_size(v)]));
      mesh.file_vertices.push_back(std::int32_t{mesh.file_vertices[to_size(v)]});
      mesh.sewn.push_back(std::int32_t{mesh.sewn[to_size(v)]});
    }
    mesh.triangles[c / 3][c % 3] = own->second;
  }
}

}  // namespace cutbench
