#include "methods/longest_edge/longest_edge.h"

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/quality.h"

namespace cutbench {

namespace {

HalfEdge longest_edge(const Sheet& sheet, TriangleIndex t) {
  HalfEdge longest = half_edge(t, 0);
  for (int k : {1, 2})
    if (squared_length(sheet, half_edge(t, k)) > squared_length(sheet, longest)) longest = half_edge(t, k);
  return longest;
}

/// The end of the longest-edge propagation path of t.
HalfEdge terminal_edge(const Sheet& sheet, TriangleIndex t) {
  HalfEdge h = longest_edge(sheet, t);
  while (!sheet.on_border(h)) {
    const HalfEdge longer = longest_edge(sheet, triangle_of(sheet.opposite(h)));
    if (squared_length(sheet, longer) <= squared_length(sheet, h)) break;
    h = longer;
  }
  return h;
}

}  // namespace

bool LongestEdge::wants_splitting(const Sheet& sheet, TriangleIndex t) const {
  if (!sheet.triangle(t).alive()) return false;
  const auto c = sheet.corners(t);
  return aspect_ratio(c[0], c[1], c[2]) > options_.max_aspect && !wedges_.hold(c);
}

/// Splits the edge at the end of t's path at its midpoint; false where it is too short, or doubles too coarse.
bool LongestEdge::split_terminal_edge(Sheet& sheet, TriangleIndex t) {
  const HalfEdge h = terminal_edge(sheet, t), o = sheet.opposite(h);
  const double floor = 2 * options_.min_edge * sheet.mean_edge();
  if (squared_length(sheet, h) < floor * floor) return false;
  const Point2 middle = 0.5 * sheet.rest(sheet.origin(h)) + 0.5 * sheet.rest(sheet.target(h));
  if (!halves_are_positive(sheet, h, middle) || !halves_are_positive(sheet, o, middle)) return false;
  const VertexIndex v = sheet.split_edge(h, 0.5, middle);
  for (const HalfEdge outgoing : outgoing_edges(sheet, v)) {
    delaunay_.add(triangle_of(outgoing));
    delaunay_.changed.push_back(triangle_of(outgoing));
  }
  return true;
}

/// Queues what the last flips and splits left ill-shaped.
void LongestEdge::note_changed(const Sheet& sheet) {
  for (const TriangleIndex t : delaunay_.changed)
    if (wants_splitting(sheet, t)) ill_shaped_.push_back(t);
  delaunay_.changed.clear();
}

void LongestEdge::improve(Sheet& sheet, MethodNotes& notes) {
  wedges_.find(sheet);
  delaunay_.begin(sheet);
  ill_shaped_.clear();
  for_each_changed(sheet, [&](TriangleIndex t) {
    delaunay_.add(t);
    delaunay_.changed.push_back(t);
  });
  delaunay_.run(sheet);
  note_changed(sheet);

  const double most = options_.cap * to_double(sheet.log().path_vertices.size());
  std::size_t made = 0, i = 0;
  for (; i < ill_shaped_.size() && to_double(made) < most; ++i) {
    const TriangleIndex t = ill_shaped_[i];
    if (!wants_splitting(sheet, t) || !split_terminal_edge(sheet, t)) continue;
    ++made;
    delaunay_.changed.push_back(t);
    delaunay_.run(sheet);
    note_changed(sheet);
  }
  notes.stopped_early = i < ill_shaped_.size();
}

}  // namespace cutbench
