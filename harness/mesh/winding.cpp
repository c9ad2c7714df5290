#include "harness/mesh/winding.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
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

/// Per triangle: it is of a part that runs clockwise as a whole. Empty: none is.
std::vector<std::uint8_t> of_clockwise_parts(const MeshData& mesh, const std::vector<std::uint8_t>& clockwise) {
  UnionFind joined(mesh.rest.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    joined.join(to_size(a), to_size(b));
    joined.join(to_size(a), to_size(c));
  }
  std::vector<std::uint8_t> otherwise(mesh.rest.size(), 0);  // some triangle of the part runs counter-clockwise
  for (std::size_t t = 0; t < clockwise.size(); ++t)
    if (!clockwise[t]) otherwise[joined.find(to_size(mesh.triangles[t][0]))] = 1;
  std::vector<std::uint8_t> result(clockwise.size());
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = !otherwise[joined.find(to_size(mesh.triangles[t][0]))];
  return std::find(result.begin(), result.end(), 1) == result.end() ? std::vector<std::uint8_t>{} : result;
}

bool in_range(const MeshData& mesh) {
  return mesh.rest.size() == mesh.deformed.size() &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Corners& triangle) {
           return std::all_of(triangle.begin(), triangle.end(),
                              [&](std::int32_t v) { return v >= 0 && v < std::ssize(mesh.rest); });
         });
}

std::vector<std::uint8_t> clockwise_triangles(const MeshData& mesh) {
  std::vector<std::uint8_t> result(mesh.triangles.size());
  std::transform(mesh.triangles.begin(), mesh.triangles.end(), result.begin(),
                 [&](const Corners& triangle) { return runs_clockwise(mesh, triangle); });
  return result;
}

}  // namespace

std::size_t turn_clockwise_triangles(MeshData& mesh) {
  const std::vector<std::uint8_t> clockwise = clockwise_triangles(mesh);
  std::size_t turned = 0;
  for (std::size_t t = 0; t < clockwise.size(); ++t) {
    if (!clockwise[t]) continue;
    turn(mesh.triangles[t]);
    ++turned;
  }
  if (turned > 0) mesh.clockwise = of_clockwise_parts(mesh, clockwise);
  return turned;
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
  const std::vector<std::uint8_t> turned = of_clockwise_parts(result, clockwise_triangles(result));
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) turn(result.triangles[t]);
}

}  // namespace cutbench
