#include "methods/tools/divided.h"

#include <algorithm>

#include "harness/base/conversions.h"
#include "harness/mesh/locator.h"

namespace cutbench {

std::vector<TriangleIndex> new_triangles(const Sheet& before, const Sheet& cut, bool only_divided) {
  std::vector<TriangleIndex> found;
  const bool reused_slots = !only_divided || before.vertex_count() != before.vertex_slots();
  for (std::size_t v = reused_slots ? 0 : before.vertex_slots(); v < cut.vertex_slots(); ++v) {
    if (!cut.triangle_of_vertex(VertexIndex(v)).valid() || !cut.is_newer(VertexIndex(v), before)) continue;
    const HalfEdge first = cut.first_outgoing(VertexIndex(v));
    HalfEdge h = first;
    do found.push_back(triangle_of(h));
    while ((h = cut.next_outgoing(h)).valid() && h != first);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool is_part(const Sheet& before, const Sheet& cut, TriangleIndex t) {
  const auto& v = cut.triangle(t).vertex;
  return std::any_of(v.begin(), v.end(), [&](VertexIndex w) { return cut.is_newer(w, before); });
}

std::vector<TriangleIndex> last_new_triangles(const Sheet& before, const Sheet& cut) {
  std::vector<TriangleIndex> found;
  const auto look_at = [&](TriangleIndex t) {
    if (cut.triangle(t).alive() && is_part(before, cut, t)) found.push_back(t);
  };
  for (const auto& touched : cut.log().touched) look_at(touched.slot);
  for (std::size_t t = cut.log().triangles_before; t < cut.triangle_slots(); ++t) look_at(TriangleIndex(t));
  std::sort(found.begin(), found.end());
  return found;
}

TriangleIndex parent_of(const Sheet& before, const Sheet& cut, TriangleIndex part, TriangleIndex start) {
  if (part() < before.triangle_slots() && before.triangle(part).alive()) start = part;
  const auto c = cut.corners(part);
  return triangle_at(before, start, 1.0 / 3 * (c[0] + c[1] + c[2]));
}

std::vector<DividedTriangle> divided_triangles(const Sheet& before, const Sheet& cut) {
  std::vector<DividedTriangle> divided;
  for (const TriangleIndex t : new_triangles(before, cut, true)) {
    divided.push_back({t, parent_of(before, cut, t, divided.empty() ? TriangleIndex{0} : divided.back().parent)});
  }
  return divided;
}

}  // namespace cutbench
