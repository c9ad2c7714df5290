#include "harness/cut/open.h"

#include <algorithm>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// The first outgoing edge of v, counter-clockwise, that separates; on the border the first outgoing one of all; none
/// where nothing separates.
HalfEdge some_separating_edge(const Sheet& sheet, VertexIndex v) {
  const TriangleIndex t = sheet.triangle_of_vertex(v);
  const auto& corner = sheet.triangle(t).vertex;
  const HalfEdge start = half_edge(t, corner[0] == v ? 0 : corner[1] == v ? 1 : 2);
  HalfEdge h = start;
  do {
    if (sheet.separates(h)) return h;
    h = sheet.next_outgoing(h);
  } while (h.valid() && h != start);
  return h.valid() ? HalfEdge() : sheet.first_outgoing(v);
}

/// Gives each fan from outgoing edge `first` on a deformed vertex of its own. False where that ended at the border and
/// not back at `first`. `seen` is working storage.
bool separate_fans(Sheet& sheet, HalfEdge first, std::vector<DeformedIndex>& seen) {
  seen.clear();
  bool copied = false;
  DeformedIndex mine;
  HalfEdge h = first;
  do {
    const Triangle& triangle = sheet.triangle(triangle_of(h));
    const auto k = to_size(corner_of(h));
    const HalfEdge left = triangle.opposite[k == 0 ? 2 : k - 1];
    if (!triangle.opposite[k].valid() || triangle.mark[k] != EdgeMark::none) {  // a fan begins
      mine = triangle.deformed[k];
      copied = std::find(seen.begin(), seen.end(), mine) != seen.end();
      if (copied)
        mine = sheet.copy_deformed(mine);
      else
        seen.push_back(mine);
      if (triangle.mark[k] == EdgeMark::path) sheet.set_mark(h, EdgeMark::incision);
    }
    if (copied) sheet.set_deformed(triangle_of(h), to_int(k), mine);
    h = left;
  } while (h.valid() && h != first);
  return h.valid();
}

}  // namespace

void open_path(Sheet& sheet) {
  std::vector<DeformedIndex> seen;
  for (auto v : sheet.log().path_vertices) {
    if (!sheet.triangle_of_vertex(v).valid()) continue;  // collapsed
    const HalfEdge outgoing = some_separating_edge(sheet, v);
    if (!outgoing.valid() || separate_fans(sheet, outgoing, seen) || sheet.on_border(outgoing)) continue;
    separate_fans(sheet, sheet.first_outgoing(v), seen);  // a border vertex: again, from the border on
  }
}

}  // namespace cutbench
