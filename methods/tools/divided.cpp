#include "methods/tools/divided.h"

#include <algorithm>
#include <utility>

#include "harness/mesh/predicates.h"

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

std::vector<TriangleIndex> last_new_triangles(const Sheet& before, const Sheet& cut) {
  std::vector<TriangleIndex> found;
  const auto look_at = [&](TriangleIndex t) {
    const Triangle& triangle = cut.triangle(t);
    const auto& v = triangle.vertex;
    if (triangle.alive() && std::any_of(v.begin(), v.end(), [&](VertexIndex w) { return cut.is_newer(w, before); }))
      found.push_back(t);
  };
  for (const auto& touched : cut.log().touched) look_at(touched.slot);
  for (std::size_t t = cut.log().triangles_before; t < cut.triangle_slots(); ++t) look_at(TriangleIndex(t));
  std::sort(found.begin(), found.end());
  return found;
}

TriangleIndex triangle_at(const Sheet& sheet, TriangleIndex start, Point2 p) {
  const auto step = [&](TriangleIndex t) {  // itself where it holds p, invalid beyond the border
    const auto c = sheet.corners(t);
    for (int k = 0; k < 3; ++k)
      if (const auto i = static_cast<std::size_t>(k); orientation(c[i], c[(i + 1) % 3], p) < 0) {
        const HalfEdge o = sheet.opposite(half_edge(t, k));
        return o.valid() ? triangle_of(o) : TriangleIndex();
      }
    return t;
  };
  TriangleIndex last, t = start;
  for (std::size_t i = 0; t.valid() && i < sheet.triangle_slots(); ++i) {
    const TriangleIndex next = step(t);
    if (next == t) return t;
    last = std::exchange(t, next);
  }
  // Past a notch of the border.
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    if (sheet.triangle(TriangleIndex(i)).alive() && step(TriangleIndex(i)) == TriangleIndex(i)) return TriangleIndex(i);
  return last;
}

std::vector<DividedTriangle> divided_triangles(const Sheet& before, const Sheet& cut) {
  std::vector<DividedTriangle> divided;
  for (const TriangleIndex t : new_triangles(before, cut, true)) {
    // A part keeps its parent's slot, and slots follow the path: the walk is short.
    TriangleIndex start = t() < before.triangle_slots() ? t : divided.back().parent;
    const auto c = cut.corners(t);
    divided.push_back({t, triangle_at(before, start, 1.0 / 3 * (c[0] + c[1] + c[2]))});
  }
  return divided;
}

}  // namespace cutbench
