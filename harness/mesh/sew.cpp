#include "harness/mesh/sew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"

namespace cutbench {

namespace {

/// Corners of edges that have one triangle, and are triangles' corners at all.
std::vector<std::size_t> border_vertices(const MeshData& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> vertices;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::find_if(edge, edges.end(), [&](const auto& other) { return other != *edge; });
    if (next - edge == 1)
      for (const auto v : {edge->first, edge->second})
        if (v >= 0 && v < std::ssize(mesh.deformed)) vertices.push_back(to_size(v));
    edge = next;
  }
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

void weld_in_space(MeshData& mesh, double tolerance, bool in_plane, const std::string& name) {
  UnionFind joined(mesh.deformed.size());
  std::size_t count = 0, lips = 0;
  for_each_pair(mesh, border_vertices(mesh), tolerance, [&](std::size_t a, std::size_t b) {
    if (joined.find(a) == joined.find(b)) return;
    if (in_plane && mesh.deformed[a] == mesh.deformed[b]) {
      ++lips;
      return;
    }
    joined.join(a, b);
    ++count;
  });
  for (auto& triangle : mesh.triangles)
    for (auto& v : triangle)
      if (v >= 0 && v < std::ssize(mesh.deformed)) v = to_int32(joined.find(to_size(v)));
  mesh.notes.push_back(name + ": vertices sewn to others: " + std::to_string(count));
  if (lips > 0)
    mesh.notes.push_back(name + ": pairs of vertices at equal places in a plane: " + std::to_string(lips) +
                         "; they are the lips of an incision, which --sew leaves open; if they are a seam, merge them "
                         "in the file, or give --rest space");
}

namespace {

/// Some of the last of six digits of the largest coordinate, but far less than any two neighbours are apart.
double digits_of_files(const MeshData& mesh) {
  double largest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 &p = mesh.deformed[to_size(t[k])], &q = mesh.deformed[to_size(t[(k + 1) % 3])];
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      shortest = std::min(shortest, length(q + -1.0 * p));
    }
  return std::min(5e-6 * largest, 0.01 * shortest);
}

}  // namespace

Unsewn unsewn(const MeshData& mesh) {
  const double near = digits_of_files(mesh);
  Unsewn found;
  std::vector<char> counted(mesh.deformed.size());
  for_each_pair(mesh, border_vertices(mesh), near, [&](std::size_t a, std::size_t b) {
    const bool sewn = !mesh.sewn.empty() && mesh.sewn[a] == mesh.sewn[b];
    if (mesh.rest[a] == mesh.rest[b] || sewn) return;
    counted[b] = 1;
    found.distance = std::max(found.distance, length(mesh.deformed[b] + -1.0 * mesh.deformed[a]));
  });
  found.count = to_size(std::count(counted.begin(), counted.end(), 1));
  return found;
}

}  // namespace cutbench
