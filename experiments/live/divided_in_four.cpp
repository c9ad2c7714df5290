#include "experiments/live/divided_in_four.h"

#include <algorithm>
#include <map>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench::live {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;  // its vertices, the smaller number first
using Middles = std::map<Edge, std::int32_t>;

/// Middles of edges whose ends are sewn together are sewn, too.
void sew_middles(const Middles& middles, std::vector<std::int32_t>& sewn) {
  std::map<Edge, std::int32_t> first;
  for (const auto& [edge, middle] : middles) {
    const Edge points = std::minmax(sewn[to_size(edge.first)], sewn[to_size(edge.second)]);
    sewn[to_size(middle)] = first.try_emplace(points, middle).first->second;
  }
}

}  // namespace

MeshData divided_in_four(const MeshData& coarse) {
  MeshData fine = coarse;
  fine.triangles.clear();
  Middles middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), to_int32(fine.rest.size()));
    if (is_new) {
      const Point2 p = coarse.rest[to_size(a)], q = coarse.rest[to_size(b)];
      const Point3 x = coarse.deformed[to_size(a)], y = coarse.deformed[to_size(b)];
      fine.rest.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
      fine.deformed.push_back({(x.x + y.x) / 2, (x.y + y.y) / 2, (x.z + y.z) / 2});
    }
    return place->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& triangle : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(triangle);
  }
  fine.file_vertices.clear();
  if (fine.sewn.empty()) return fine;
  fine.sewn.resize(fine.rest.size());
  sew_middles(middles, fine.sewn);
  return fine;
}

}  // namespace cutbench::live
