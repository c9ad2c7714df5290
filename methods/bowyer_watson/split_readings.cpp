#include "methods/bowyer_watson/split_readings.h"

#include <algorithm>
#include <array>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"

namespace cutbench {

void SplitReading::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  crossed_.clear();
  for (const auto& face : trace.faces) crossed_.push_back(sheet.corners(face.triangle));
  BowyerWatson::embed(sheet, trace, notes);
}

bool SplitReading::is_ill_shaped(const Sheet& sheet, TriangleIndex t) const {
  if (!sheet.triangle(t).alive()) return false;
  const auto c = sheet.corners(t);
  return aspect_ratio(c[0], c[1], c[2]) > options_.max_aspect;
}

/// At its midpoint, where that is possible in doubles.
void SplitReading::split(Sheet& sheet, HalfEdge h) {
  const double floor = 2 * options_.min_edge * sheet.mean_edge();
  const HalfEdge o = sheet.opposite(h);
  const Point2 middle = 0.5 * sheet.rest(sheet.origin(h)) + 0.5 * sheet.rest(sheet.target(h));
  if (squared_length(sheet, h) < floor * floor) return;
  if (!halves_are_positive(sheet, h, middle) || !halves_are_positive(sheet, o, middle)) return;
  const auto group_of = [&](HalfEdge side) { return side.valid() ? group_.get(triangle_of(side), -1) : -1; };
  const std::array apexes{sheet.origin(Sheet::previous(h)),
                          o.valid() ? sheet.origin(Sheet::previous(o)) : VertexIndex{}};
  const std::array groups{group_of(h), group_of(o)};
  const VertexIndex v = sheet.split_edge(h, 0.5, middle);
  group_.grow(sheet.triangle_slots());
  for_each_outgoing(sheet, v, [&](HalfEdge out) {
    const TriangleIndex t = triangle_of(out);
    const auto& corners = sheet.triangle(t).vertex;
    const bool left = std::find(corners.begin(), corners.end(), apexes[0]) != corners.end();
    group_.set(t, groups[left ? 0 : 1]);
    delaunay_.add(t);
    for (int k = 0; k < 3; ++k) open_.push_back(half_edge(t, k));
  });
}

void SplitReading::split_edges_of(Sheet& sheet, TriangleIndex t) {
  std::array<VertexIndex, 3> v = sheet.triangle(t).vertex;
  std::array<int, 3> longest_first{0, 1, 2};
  std::sort(longest_first.begin(), longest_first.end(), [&](int a, int b) {
    return squared_length(sheet, half_edge(t, a)) > squared_length(sheet, half_edge(t, b));
  });
  const int count = reading_ == Reading::longest_edge ? 1 : 2;
  for (int i = 0; i < count; ++i) {
    const int k = longest_first[to_size(i)];
    const VertexIndex from = v[to_size(k)], to = v[to_size(next_corner(k))];
    HalfEdge edge;  // the first split may have given it another triangle
    for_each_outgoing(sheet, from, [&](HalfEdge out) {
      if (sheet.target(out) == to) edge = out;
    });
    if (edge.valid()) split(sheet, edge);
  }
}

void SplitReading::find_groups(const Sheet& sheet) {
  group_.clear(sheet.triangle_slots());
  for_each_changed(sheet, [&](TriangleIndex t) {
    if (!sheet.triangle(t).alive()) return;
    const auto c = sheet.corners(t);
    const Point2 p = 1.0 / 3 * (c[0] + c[1] + c[2]);
    const auto holds = [&](const std::array<Point2, 3>& x) {
      return orientation(x[0], x[1], p) > 0 && orientation(x[1], x[2], p) > 0 && orientation(x[2], x[0], p) > 0;
    };
    const auto in = std::find_if(crossed_.begin(), crossed_.end(), holds);
    if (in != crossed_.end()) group_.set(t, to_int(in - crossed_.begin()));
  });
}

/// Lawson's flips of edges between two triangles of a group.
void SplitReading::flip_within_groups(Sheet& sheet) {
  while (!open_.empty()) {
    const HalfEdge h = open_.back();
    open_.pop_back();
    if (!sheet.triangle(triangle_of(h)).alive() || sheet.separates(h)) continue;
    const TriangleIndex t = triangle_of(h), u = triangle_of(sheet.opposite(h));
    if (group_.get(t, -1) < 0 || group_.get(t, -1) != group_.get(u, -1)) continue;
    const auto c = sheet.corners(t);
    if (in_circle(c[0], c[1], c[2], sheet.rest(sheet.origin(Sheet::previous(sheet.opposite(h))))) <= 0) continue;
    if (sheet.flip(h))
      for (const TriangleIndex changed : {t, u})
        for (int k = 0; k < 3; ++k) open_.push_back(half_edge(changed, k));
  }
}

void SplitReading::improve(Sheet& sheet, MethodNotes& notes) {
  find_groups(sheet);
  delaunay_.begin(sheet);
  const std::size_t embedded = sheet.log().new_vertices.size();
  for (int round = 0; round < options_.rounds; ++round) {
    ill_shaped_.clear();
    for_each_changed(sheet, [&](TriangleIndex t) {
      if (is_ill_shaped(sheet, t)) ill_shaped_.push_back(t);
    });
    for (const TriangleIndex t : ill_shaped_) {
      if (sheet.log().new_vertices.size() > options_.most_vertices) {
        notes.stopped_early = true;
        notes.improved_nothing = sheet.log().new_vertices.size() == embedded;
        return;
      }
      if (!is_ill_shaped(sheet, t)) continue;
      split_edges_of(sheet, t);
      if (reading_ != Reading::grouped) delaunay_.run(sheet);
    }
    if (reading_ == Reading::grouped) flip_within_groups(sheet);
    open_.clear();
  }
}

}  // namespace cutbench
