// The part of Reshape for corners where the path meets older incisions, the border or itself at a small angle, and its
// way of dividing an edge at a point beside it.
#include <cmath>

#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "methods/tools/reshape.h"

namespace cutbench {

/// The vertex is made on the edge and then moved, so that its deformed position is interpolated in the old triangles.
VertexIndex Reshape::split_at(HalfEdge h, Point2 p) { return split_beside(*sheet_, h, p); }

/// Turns the first piece of the path, from the apex to v or to a new vertex before v, about the apex, until it encloses
/// a large enough angle with the other leg. False where that is not allowed.
bool Reshape::turn_away(VertexIndex v, VertexIndex apex, VertexIndex other) {
  // Of 0.37 radians: a triangle with two sides this far apart has an aspect ratio of 2.8. Written out, since the C
  // libraries round them differently.
  constexpr double cosine = 0.9323273456060345, sine = 0.361615431964962;
  constexpr double sharpest = 0.17;  // a sine; below it the curves themselves enclose too little
  Neighbours n;
  if (freedom(v, n) != Freedom::along || (n.before != apex && n.after != apex)) return false;
  const VertexIndex beyond = n.before == apex ? n.after : n.before;
  const double from = curve_->parameter(apex), end = curve_->parameter(v);
  if (!curve_->is_piece(from, end)) return false;
  const Point2 at = sheet_->rest(apex), along = sheet_->rest(other) - at;
  const double side = cross(along, sheet_->rest(v) - at) > 0 ? 1 : -1;
  const double c = cosine / std::sqrt(squared_length(along));
  const double s = side * sine / std::sqrt(squared_length(along));
  const Point2 direction{c * along.x - s * along.y, s * along.x + c * along.y};
  for (const double share : {1.0, 0.5, 0.25}) {
    const double here = from + share * (end - from);
    const Point2 was = curve_->at(here), leg = was - at, to = at + std::sqrt(squared_length(leg)) * direction;
    if (side * cross(along, leg) < sharpest * std::sqrt(squared_length(along) * squared_length(leg))) continue;
    const bool whole = share == 1;
    const VertexIndex next = whole ? beyond : v;
    if (squared_length(to - was) > tolerance_ * tolerance_ || !curve_->stays_near(from, here, at, to, tolerance_) ||
        !curve_->stays_near(here, curve_->parameter(next), to, sheet_->rest(next), tolerance_))
      continue;
    if (whole) {
      if (!sheet_->move(v, to)) continue;
      curve_->set_parameter(v, -1);  // off the curve: it must stay there
      return true;
    }
    if (split_at(find_half_edge(*sheet_, apex, v), to).valid()) return true;
  }
  return false;
}

/// Halves a long piece of the path at a point of the curve.
void Reshape::follow_closely(VertexIndex from, VertexIndex to) {
  const HalfEdge h = find_half_edge(*sheet_, from, to);
  const double s = curve_->parameter(from), e = curve_->parameter(to);
  if (!h.valid() || sheet_->mark(h) != EdgeMark::path) return;
  const Point2 a = sheet_->rest(from), b = sheet_->rest(to);
  if (squared_length(b - a) < 0.25 * h_ * h_ || !curve_->may_divide(s, e, a, b, tolerance_)) return;
  if (const VertexIndex v = split_at(h, curve_->at((s + e) / 2)); v.valid()) curve_->add(v, (s + e) / 2);
}

void Reshape::widen_corners() {
  corners_.clear();
  for_each_sharp_corner(*sheet_, [&](VertexIndex apex, VertexIndex right, VertexIndex left) {
    corners_.push_back({apex, right, left});
  });
  for (const auto& [apex, right, left] : corners_) {
    if (turn_away(left, apex, right) || turn_away(right, apex, left)) continue;
    for (const VertexIndex v : {left, right}) follow_closely(apex, v);
  }
}

void Reshape::find_wedges(bool widen) {
  wedges_.find(*sheet_);
  if (!widen || wedges_.empty()) return;
  widen_corners();
  wedges_.find(*sheet_);
}

}  // namespace cutbench
