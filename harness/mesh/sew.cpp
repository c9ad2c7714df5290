#include "harness/mesh/sew.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"

namespace cutbench {

namespace {

/// Corners of edges that have one triangle, and are triangles' corners at all.
std::vector<std::size_t> border_vertices(const MeshData& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax({t[k], t[(k + 1) % 3]})];
  std::vector<std::size_t> vertices;
  for (const auto& [ends, count] : uses)
    if (count == 1)
      for (const auto v : {ends.first, ends.second})
        if (v >= 0 && v < std::ssize(mesh.deformed)) vertices.push_back(to_size(v));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Calls act(a, b), a < b, for all of `vertices` that are no farther apart than `tolerance`.
template <class Act>
void for_each_pair(const MeshData& mesh, std::vector<std::size_t> vertices, double tolerance, const Act& act) {
  const auto at = [&](std::size_t v) { return mesh.deformed[v]; };
  const auto key = [&](std::size_t v) { return std::tuple(at(v).x, at(v).y, at(v).z, v); };
  std::sort(vertices.begin(), vertices.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t k = i + 1; k < vertices.size() && at(vertices[k]).x - at(vertices[i]).x <= tolerance; ++k)
      if (length(at(vertices[k]) + -1.0 * at(vertices[i])) <= tolerance)
        act(std::min(vertices[i], vertices[k]), std::max(vertices[i], vertices[k]));
}

}  // namespace

void sew(MeshData& mesh, double tolerance, const std::string& name) {
  if (mesh.sewn.empty()) {
    mesh.sewn.resize(mesh.rest.size());
    std::iota(mesh.sewn.begin(), mesh.sewn.end(), 0);
  }
  UnionFind joined(mesh.rest.size());
  for (std::size_t v = 0; v < mesh.sewn.size(); ++v) joined.join(v, to_size(mesh.sewn[v]));
  std::size_t count = 0;
  for_each_pair(mesh, border_vertices(mesh), tolerance, [&](std::size_t a, std::size_t b) {
    if (mesh.rest[a] == mesh.rest[b] || joined.find(a) == joined.find(b)) return;
    joined.join(a, b);
    ++count;
  });
  for (std::size_t v = 0; v < mesh.sewn.size(); ++v) mesh.sewn[v] = to_int32(joined.find(v));
  mesh.notes.push_back(name + ": vertices sewn to others: " + std::to_string(count));
}

void weld_in_space(MeshData& mesh, double tolerance, const std::string& name) {
  UnionFind joined(mesh.deformed.size());
  std::size_t count = 0;
  for_each_pair(mesh, border_vertices(mesh), tolerance, [&](std::size_t a, std::size_t b) {
    if (joined.find(a) == joined.find(b)) return;
    joined.join(a, b);
    ++count;
  });
  for (auto& triangle : mesh.triangles)
    for (auto& v : triangle)
      if (v >= 0 && v < std::ssize(mesh.deformed)) v = to_int32(joined.find(to_size(v)));
  mesh.notes.push_back(name + ": vertices sewn to others: " + std::to_string(count));
}

namespace {

/// Do two vertices lie at one place in space, but not at rest? Most meshes have none.
bool any_apart_at_rest(const MeshData& mesh) {
  std::vector<std::size_t> order(mesh.deformed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) {
    const Point3 &p = mesh.deformed[a], &q = mesh.deformed[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (!before(order[i - 1], order[i]) && mesh.rest[order[i - 1]] != mesh.rest[order[i]]) return true;
  return false;
}

}  // namespace

std::size_t unsewn(const MeshData& mesh) {
  if (!any_apart_at_rest(mesh)) return 0;
  std::vector<char> counted(mesh.deformed.size());
  for_each_pair(mesh, border_vertices(mesh), 0, [&](std::size_t a, std::size_t b) {
    const bool sewn = !mesh.sewn.empty() && mesh.sewn[a] == mesh.sewn[b];
    if (mesh.rest[a] != mesh.rest[b] && !sewn) counted[b] = 1;
  });
  return to_size(std::count(counted.begin(), counted.end(), 1));
}

}  // namespace cutbench
