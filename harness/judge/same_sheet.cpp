#include "harness/judge/same_sheet.h"

namespace cutbench {

std::string difference(const Sheet& a, const Sheet& b) {
  if (a.triangle_slots() != b.triangle_slots() || a.triangle_count() != b.triangle_count()) return "triangle count";
  if (a.vertex_slots() != b.vertex_slots() || a.vertex_count() != b.vertex_count()) return "vertex count";
  if (a.deformed_slots() != b.deformed_slots() || a.deformed_count() != b.deformed_count()) return "deformed count";
  for (std::size_t i = 0; i < a.triangle_slots(); ++i) {
    const Triangle &t = a.triangle(TriangleIndex(i)), &u = b.triangle(TriangleIndex(i));
    const auto what = [i](const char* part) { return std::string(part) + " of triangle " + std::to_string(i); };
    if (t.alive() != u.alive()) return what("life");
    if (!t.alive()) continue;
    if (t.vertex != u.vertex) return what("vertices");
    if (t.opposite != u.opposite) return what("neighbours");
    if (t.deformed != u.deformed) return what("deformed vertices");
    if (t.mark != u.mark) return what("marks");
  }
  for (std::size_t i = 0; i < a.vertex_slots(); ++i) {
    const VertexIndex v(i);
    if (a.triangle_of_vertex(v) != b.triangle_of_vertex(v)) return "triangle of vertex " + std::to_string(i);
    if (a.triangle_of_vertex(v).valid() && !same_bits(a.rest(v), b.rest(v))) return "rest vertex " + std::to_string(i);
  }
  for (std::size_t i = 0; i < a.deformed_slots(); ++i) {
    const DeformedIndex d(i);
    if (a.rest_vertex(d) != b.rest_vertex(d)) return "rest vertex of deformed vertex " + std::to_string(i);
    if (a.rest_vertex(d).valid() && !same_bits(a.position(d), b.position(d))) return "position " + std::to_string(i);
  }
  return a.mean_edge() == b.mean_edge() && a.size() == b.size() && a.snap() == b.snap() ? "" : "size";
}

}  // namespace cutbench
