#include "harness/mesh/local_delaunay.h"

#include <algorithm>

#include "harness/mesh/predicates.h"

namespace cutbench {

void LocalDelaunay::begin(const Sheet& sheet) {
  open_.clear();
  changed.clear();
  noted_.clear(sheet.vertex_slots());
  made_ = moved_ = 0;
  note_vertices(sheet);
}

void LocalDelaunay::note_vertices(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  noted_.grow(sheet.vertex_slots());
  for (; made_ < log.new_vertices.size(); ++made_) noted_.insert(log.new_vertices[made_]);
  for (; moved_ < log.moved.size(); ++moved_) noted_.insert(log.moved[moved_].vertex);
}

void LocalDelaunay::add(TriangleIndex t) {
  for (int k = 0; k < 3; ++k) open_.push_back(half_edge(t, k));
}

void LocalDelaunay::run(Sheet& sheet) {
  note_vertices(sheet);
  while (!open_.empty()) {
    const HalfEdge h = open_.back(), o = sheet.opposite(h);
    open_.pop_back();
    if (!o.valid() || sheet.mark(h) != EdgeMark::none) continue;
    const VertexIndex a = sheet.origin(h), b = sheet.target(h);
    const VertexIndex c = sheet.origin(Sheet::previous(h)), d = sheet.origin(Sheet::previous(o));
    if (!noted_.holds(a) && !noted_.holds(b) && !noted_.holds(c) && !noted_.holds(d)) continue;
    if (in_circle(sheet.rest(a), sheet.rest(b), sheet.rest(c), sheet.rest(d)) <= 0 || !sheet.flip(h)) continue;
    // Now a d c in the slot of h, and d b c in that of o.
    const TriangleIndex left = triangle_of(h), right = triangle_of(o);
    for (const HalfEdge outer : {half_edge(left, 0), half_edge(left, 2), half_edge(right, 0), half_edge(right, 1)})
      open_.push_back(outer);
    changed.push_back(left);
    changed.push_back(right);
  }
}

}  // namespace cutbench
