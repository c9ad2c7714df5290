#include "harness/mesh/seam_fans.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/products_in_space.h"
#include "harness/base/union_find.h"
#include "harness/mesh/seam_pairs.h"

namespace cutbench {

namespace {

/// Edges of the border that leave one point.
struct BorderEdge {
  std::size_t corner;
  std::int32_t from, to;  ///< vertices
};

/// The two sides of a seam, where one of them has vertices that the other one lacks. Not the lips of an incision.
bool lie_on_each_other(const MeshData& mesh, const BorderEdge& a, const BorderEdge& b) {
  const auto way = [&](const BorderEdge& e) {
    return mesh.deformed[to_size(e.to)] + -1.0 * mesh.deformed[to_size(e.from)];
  };
  const auto way_at_rest = [&](const BorderEdge& e) { return mesh.rest[to_size(e.to)] - mesh.rest[to_size(e.from)]; };
  const Point3 u = way(a), v = way(b);
  const Point2 p = way_at_rest(a), q = way_at_rest(b);
  const bool are_lips = mesh.rest[to_size(a.from)] == mesh.rest[to_size(b.from)] && dot(p, q) > 0 &&
                        std::abs(cross(p, q)) <= beside_line * dot(p, q);
  return !are_lips && dot(u, v) > 0 && length(cross(u, v)) <= beside_line * dot(u, v);
}

}  // namespace

void part_fans_at_seams(MeshData& mesh) {
  if (mesh.sewn.empty()) return;
  const auto vertex = [&](std::size_t c) { return mesh.triangles[c / 3][c % 3]; };
  const auto point = [&](std::size_t c) { return mesh.sewn[to_size(vertex(c))]; };
  const std::size_t corners = 3 * mesh.triangles.size();
  for (std::size_t c = 0; c < corners; ++c)
    if (vertex(c) < 0 || vertex(c) >= std::ssize(mesh.rest)) return;
  UnionFind at_rest(corners), in_space(corners);
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> edge_at_rest, edge_in_space;  // its first corner
  for (std::size_t c = 0; c < corners; ++c)
    for (const std::size_t steps : {1, 2}) {
      const std::size_t other = c - c % 3 + (c % 3 + steps) % 3;
      at_rest.join(c, edge_at_rest.try_emplace({vertex(c), vertex(other)}, c).first->second);
      in_space.join(c, edge_in_space.try_emplace({point(c), point(other)}, c).first->second);
    }
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (std::size_t c = 0; c < corners; ++c) ++uses[std::minmax(vertex(c), vertex(c - c % 3 + (c % 3 + 1) % 3))];
  std::map<std::int32_t, std::vector<BorderEdge>> border;  // by the point that they leave
  for (std::size_t c = 0; c < corners; ++c)
    for (const std::size_t steps : {1, 2})
      if (const std::int32_t to = vertex(c - c % 3 + (c % 3 + steps) % 3); uses[std::minmax(vertex(c), to)] == 1)
        border[point(c)].push_back({c, vertex(c), to});
  for (const auto& [at, edges] : border)
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (lie_on_each_other(mesh, edges[i], edges[k])) in_space.join(edges[i].corner, edges[k].corner);

  std::map<std::int32_t, std::size_t> fan_of_point, fan_of_vertex;
  std::vector<char> meets_in_point(mesh.rest.size(), 0);
  for (std::size_t c = 0; c < corners; ++c)
    if (fan_of_point.try_emplace(point(c), in_space.find(c)).first->second != in_space.find(c))
      meets_in_point[to_size(point(c))] = 1;
  std::map<std::size_t, std::int32_t> number;  // per fan at rest: its vertex
  for (std::size_t c = 0; c < corners; ++c) {
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
