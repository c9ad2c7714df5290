// The one-ring of a vertex: its outgoing half-edges and triangles, looked at where the vertex is or might be.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "harness/mesh/predicates.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

/// Aspect ratio of the triangle where it is counter-clockwise in doubles, else infinite.
inline double oriented_aspect(Point2 a, Point2 b, Point2 c) {
  const double twice_area = cross(b - a, c - a);
  if (!(twice_area > 0)) return std::numeric_limits<double>::infinity();
  return std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)}) / twice_area;
}

inline double squared_length(const Sheet& sheet, HalfEdge h) {
  return squared_length(sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h)));
}

/// Both halves of the triangle behind h are positive when p on h splits it; true past the border.
inline bool halves_are_positive(const Sheet& sheet, HalfEdge h, Point2 p) {
  if (!h.valid()) return true;
  const Point2 apex = sheet.rest(sheet.origin(Sheet::previous(h)));
  return orientation(sheet.rest(sheet.origin(h)), p, apex) > 0 && orientation(p, sheet.rest(sheet.target(h)), apex) > 0;
}

/// Splits an edge with a new vertex at p, which may lie beside it: the vertex then moves there from the edge, so that
/// its deformed position is that of the material. Invalid, unchanged, where a triangle would not stay positive.
inline VertexIndex split_beside(Sheet& sheet, HalfEdge h, Point2 p) {
  const Point2 a = sheet.rest(sheet.origin(h)), edge = sheet.rest(sheet.target(h)) - a;
  const double lambda = dot(p - a, edge) / squared_length(edge);
  const Point2 on_edge = a + lambda * edge;
  const HalfEdge o = sheet.opposite(h);
  if (!(lambda > 0 && lambda < 1)) return {};
  for (const Point2 q : {on_edge, p})
    if (!halves_are_positive(sheet, h, q) || !halves_are_positive(sheet, o, q)) return {};
  const VertexIndex v = sheet.split_edge(h, lambda, on_edge);
  if (!(on_edge == p)) sheet.move(v, p);
  return v;
}

/// The outgoing half-edges of a vertex that have a triangle on their left, counter-clockwise from the first to the
/// border or once round.
class OutgoingEdges {
 public:
  class Iterator {
   public:
    Iterator(const Sheet& sheet, HalfEdge first) : sheet_(&sheet), first_(first), at_(first) {}
    HalfEdge operator*() const { return at_; }
    Iterator& operator++() {
      at_ = sheet_->next_outgoing(at_);
      if (at_ == first_) at_ = {};
      return *this;
    }
    bool operator==(std::default_sentinel_t) const { return !at_.valid(); }

   private:
    const Sheet* sheet_;
    HalfEdge first_, at_;
  };

  OutgoingEdges(const Sheet& sheet, HalfEdge first) : sheet_(&sheet), first_(first) {}
  Iterator begin() const { return {*sheet_, first_}; }
  std::default_sentinel_t end() const { return {}; }

 private:
  const Sheet* sheet_;
  HalfEdge first_;
};

/// In the order of Sheet::first_outgoing(). The mesh must stay as it is meanwhile.
inline OutgoingEdges outgoing_edges(const Sheet& sheet, VertexIndex v) { return {sheet, sheet.first_outgoing(v)}; }

/// Calls look(outgoing edge) for every outgoing edge of v that has a triangle on its left, in no particular order:
/// without the search for the border that outgoing_edges() begins with.
template <class Look>
void for_each_outgoing(const Sheet& sheet, VertexIndex v, Look look) {
  const auto& corner = sheet.triangle(sheet.triangle_of_vertex(v)).vertex;
  const HalfEdge start = half_edge(sheet.triangle_of_vertex(v), corner[0] == v ? 0 : corner[1] == v ? 1 : 2);
  HalfEdge h = start;
  do {
    look(h);
    h = sheet.next_outgoing(h);
  } while (h.valid() && h != start);
  if (h.valid()) return;
  for (h = sheet.previous_outgoing(start); h.valid(); h = sheet.previous_outgoing(h))
    look(h);  // the border came in between
}

/// Calls look(w) for the other end of every edge at v that separates: border, incision or path.
template <class Look>
void for_each_separating_end(const Sheet& sheet, VertexIndex v, Look look) {
  for_each_outgoing(sheet, v, [&](HalfEdge h) {
    if (sheet.separates(h)) look(sheet.target(h));
    if (sheet.on_border(Sheet::previous(h))) look(sheet.origin(Sheet::previous(h)));
  });
}

/// Calls look(t) for every triangle that the cut under way has made or changed.
template <class Look>
void for_each_changed(const Sheet& sheet, Look look) {
  const EditLog& log = sheet.log();
  for (const auto& touched : log.touched)
    if (sheet.triangle(touched.slot).alive()) look(touched.slot);
  for (std::size_t t = log.triangles_before; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) look(TriangleIndex(t));
}

/// The largest aspect ratio of the triangles at v, were it at p; infinite where one would not be positive.
inline double worst_aspect(const Sheet& sheet, VertexIndex v, Point2 p) {
  double worst = 0;
  for_each_outgoing(sheet, v, [&](HalfEdge h) {
    worst =
        std::max(worst, oriented_aspect(p, sheet.rest(sheet.target(h)), sheet.rest(sheet.origin(Sheet::previous(h)))));
  });
  return worst;
}

/// Of p from the segment a b.
inline double squared_distance(Point2 p, Point2 a, Point2 b) {
  const double length2 = squared_length(b - a);
  const double s = length2 > 0 ? std::clamp(dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
  return squared_length(p - (a + s * (b - a)));
}

/// Can border vertex v slide along the border without changing the sheet's shape, but for rounding?
inline bool is_straight_at(const Sheet& sheet, VertexIndex v) {
  const HalfEdge right = sheet.first_outgoing(v);
  HalfEdge left = right;
  for (HalfEdge h = right; h.valid(); h = sheet.next_outgoing(h)) {
    if (h != right && sheet.mark(h) != EdgeMark::none) return false;
    left = h;
  }
  const Point2 a = sheet.rest(sheet.target(right)), b = sheet.rest(sheet.origin(Sheet::previous(left)));
  return std::abs(cross(b - a, sheet.rest(v) - a)) <=
         straight_border_tolerance * sheet.snap() * std::sqrt(squared_length(b - a));
}

}  // namespace cutbench
