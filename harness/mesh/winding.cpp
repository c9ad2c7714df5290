#include "harness/mesh/winding.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/parts_at_rest.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Corners = std::array<std::int32_t, 3>;

bool runs_clockwise(const MeshData& mesh, const Corners& triangle) {
  for (std::int32_t v : triangle)
    if (const Point2 p = mesh.rest[to_size(v)]; !std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  const auto rest = [&](std::size_t k) { return mesh.rest[to_size(triangle[k])]; };
  return orientation(rest(0), rest(1), rest(2)) < 0;
}

void turn(Corners& triangle) { std::swap(triangle[1], triangle[2]); }

bool in_range(const MeshData& mesh) {
  return mesh.rest.size() == mesh.deformed.size() &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Corners& triangle) {
           return std::all_of(triangle.begin(), triangle.end(),
                              [&](std::int32_t v) { return v >= 0 && v < std::ssize(mesh.rest); });
         });
}

}  // namespace

std::vector<std::uint8_t> of_clockwise_parts(const MeshData& mesh, const std::vector<std::uint8_t>& clockwise) {
  UnionFind part = parts_at_rest(mesh);
  const auto part_of = [&](std::size_t t) { return part.find(to_size(mesh.triangles[t][0])); };
  std::vector<std::uint8_t> otherwise(mesh.rest.size(), 0);  // some triangle of the part runs counter-clockwise
  for (std::size_t t = 0; t < clockwise.size(); ++t)
    if (!clockwise[t]) otherwise[part_of(t)] = 1;
  std::vector<std::uint8_t> result(clockwise.size());
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = !otherwise[part_of(t)];
  return std::find(result.begin(), result.end(), 1) == result.end() ? std::vector<std::uint8_t>{} : result;
}

void wind_as_read(const MeshData& read, const Sheet& cut, const Parents& parents, MeshData& result, Texture& texture) {
  if (read.clockwise.empty()) return;
  std::size_t row = 0;
  for (std::size_t t = 0; t < cut.triangle_slots(); ++t) {
    if (!cut.triangle(TriangleIndex(t)).alive()) continue;
    if (read.clockwise[parents.triangles[t]()]) {
      turn(result.triangles[row]);
      if (!texture.empty()) std::swap(texture[row][1], texture[row][2]);
    }
    ++row;
  }
}

void turn_clockwise_parts(const MeshData& read, MeshData& result) {
  if (read.clockwise.empty() || !in_range(result)) return;
  std::vector<std::uint8_t> clockwise(result.triangles.size());
  std::transform(result.triangles.begin(), result.triangles.end(), clockwise.begin(),
                 [&](const Corners& triangle) { return runs_clockwise(result, triangle); });
  const std::vector<std::uint8_t> turned = of_clockwise_parts(result, clockwise);
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) turn(result.triangles[t]);
}

}  // namespace cutbench
