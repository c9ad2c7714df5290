#include "harness/oracle/sheet_topology.h"

#include <numeric>

#include "harness/oracle/conversions.h"

namespace cutbench::oracle {
namespace {

int origin(const Mesh& mesh, int half_edge) { return mesh.triangles[half_edge / 3][half_edge % 3]; }
int target(const Mesh& mesh, int half_edge) { return origin(mesh, next(half_edge)); }

/// Half-edges by origin: those of vertex v are list[first[v]] .. list[first[v + 1] - 1]. Their targets lie side by
/// side, too, because they are looked through for every half-edge.
struct Outgoing {
  std::vector<int> first, list, target;
};

Outgoing outgoing(const Mesh& mesh) {
  const int count = to_int(3 * mesh.triangles.size());
  Outgoing out{std::vector<int>(mesh.rest.size() + 1, 0), std::vector<int>(count), std::vector<int>(count)};
  for (int e = 0; e < count; ++e) ++out.first[origin(mesh, e) + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  std::vector<int> end(out.first);
  for (int e = 0; e < count; ++e) {
    const int i = end[origin(mesh, e)]++;
    out.list[i] = e;
    out.target[i] = target(mesh, e);
  }
  return out;
}

/// Number of corners in the fan round the origin of `start`.
int fan_size(const HalfEdges& edges, int start) {
  int size = 1;
  int e = start;
  while ((e = edges.opposite[previous(e)]) >= 0 && e != start) ++size;
  if (e == start) return size;
  e = start;
  while ((e = edges.opposite[e]) >= 0) {
    e = next(e);
    ++size;
  }
  return size;
}

}  // namespace

Segment segment(const Mesh& mesh, int half_edge) {
  return {mesh.rest[origin(mesh, half_edge)], mesh.rest[target(mesh, half_edge)]};
}

HalfEdges half_edges(const Mesh& mesh) {
  const Outgoing out = outgoing(mesh);
  const int count = to_int(3 * mesh.triangles.size());
  HalfEdges edges{std::vector<int>(count, -1), {}};
  for (int e = 0; e < count; ++e) {
    const int from = origin(mesh, e), to = target(mesh, e);
    for (int i = out.first[to]; i < out.first[to + 1]; ++i)
      if (out.target[i] == from) edges.opposite[e] = out.list[i];
    for (int i = out.first[from]; i < out.first[from + 1]; ++i)
      if (out.target[i] == to && out.list[i] != e) {
        edges.repeated.push_back(e);
        break;
      }
  }
  return edges;
}

std::vector<int> bow_ties(const Mesh& mesh, const HalfEdges& edges) {
  const Outgoing out = outgoing(mesh);
  std::vector<int> result;
  for (int v = 0; v < to_int(mesh.rest.size()); ++v) {
    const int corners = out.first[v + 1] - out.first[v];
    if (corners > 0 && fan_size(edges, out.list[out.first[v]]) != corners) result.push_back(v);
  }
  return result;
}

std::vector<int> unused_vertices(const Mesh& mesh) {
  std::vector<char> used(mesh.rest.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (int v : triangle) used[v] = 1;
  std::vector<int> result;
  for (int v = 0; v < to_int(used.size()); ++v)
    if (!used[v]) result.push_back(v);
  return result;
}

std::vector<int> pieces_of_triangles(const HalfEdges& edges) {
  std::vector<int> piece(edges.opposite.size() / 3, -1), open;
  int pieces = 0;
  for (int seed = 0; seed < to_int(piece.size()); ++seed) {
    if (piece[seed] >= 0) continue;
    piece[seed] = pieces;
    open.push_back(seed);
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int e = 3 * t; e < 3 * t + 3; ++e) {
        const int other = edges.opposite[e] < 0 ? t : edges.opposite[e] / 3;
        if (piece[other] < 0) {
          piece[other] = pieces;
          open.push_back(other);
        }
      }
    }
    ++pieces;
  }
  return piece;
}

Borders borders(const Mesh& mesh, const HalfEdges& edges) {
  struct Keyed {
    Segment key;  // the smaller rest point first
    int half_edge;
  };
  std::vector<Keyed> all;
  for (int e = 0; e < to_int(edges.opposite.size()); ++e) {
    if (edges.opposite[e] >= 0) continue;
    Segment key = segment(mesh, e);
    if (key[1] < key[0]) std::swap(key[0], key[1]);
    all.push_back({key, e});
  }
  std::sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });

  Borders result;
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].key == all[i].key) ++end;
    const int e = all[i].half_edge;
    if (end - i == 1) {
      result.single.push_back(e);
    } else if (end - i == 2 && segment(mesh, e) != segment(mesh, all[i + 1].half_edge)) {
      result.lips.push_back({e, all[i + 1].half_edge});
    } else {
      for (std::size_t j = i; j < end; ++j) result.ambiguous.push_back(all[j].half_edge);
    }
  }
  return result;
}

EdgeLengths edge_lengths(const Mesh& mesh, const HalfEdges& edges) {
  EdgeLengths result;
  int count = 0;
  for (int e = 0; e < to_int(edges.opposite.size()); ++e) {
    if (edges.opposite[e] > e) continue;
    const Segment s = segment(mesh, e);
    const double length = distance(s[0], s[1]);
    result.mean += length;
    result.longest = std::max(result.longest, length);
    ++count;
  }
  if (count > 0) result.mean /= count;
  return result;
}

}  // namespace cutbench::oracle
