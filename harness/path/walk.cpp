#include "harness/path/walk.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

constexpr Passage outside{Passage::Kind::outside, {}, {}};

}  // namespace

bool are_together(const Sheet& sheet, const Place& a, const Place& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == Place::Kind::vertex) return a.vertex == b.vertex;
  if (a.kind == Place::Kind::edge) return a.edge == b.edge || a.edge == sheet.opposite(b.edge);
  return a.point == b.point;
}

Point2 divide(Point2 a, Point2 b, double from_a, double from_b, double& lambda) {
  lambda = from_a / (from_a + from_b);
  if (from_a == from_b) return 0.5 * a + 0.5 * b;
  return from_a < from_b ? a + lambda * (b - a) : b + from_b / (from_a + from_b) * (a - b);
}

/// Side of p on the line a -> b. The snap distance is at least 8 ulp of the largest coordinate and thousands of times
/// the rounding error of the determinant, so the sign of what is not snapped is the exact one; builds with assertions
/// hold every single decision against the exact predicate.
Walk::Side Walk::side(Point2 a, Point2 b, Point2 p) const {
  const Point2 ab = b - a;
  const double area = cross(ab, p - a);
  if (std::abs(area) <= line_tolerance * snap_ * std::max(std::abs(ab.x), std::abs(ab.y))) return {area, 0};
  const int sign = area > 0 ? 1 : -1;
  assert(sign == orientation(a, b, p));
  return {area, sign};
}

Step Walk::reach(Passage passage, Place place) {
  at_ = place;
  origin_ = place.point;
  crossing_ = false;
  return {passage, place, true};
}

/// Like arrive(), where the target is known to lie clearly on the left of two of the edges, and `third` is the other.
Step Walk::arrive_behind(HalfEdge third, Point2 target) {
  const TriangleIndex t = triangle_of(third);
  if (side(rest(sheet_.origin(third)), rest(sheet_.target(third)), target).sign > 0)
    return reach(through_face(t), place_in(t, target));
  return arrive(t, target);
}

/// Vertex v lies on the line, before the target or at it. The line stays what it was, so that deviations don't add up,
/// and the way back is the way there.
Step Walk::pass_vertex(Passage passage, VertexIndex v, Point2 target) {
  const Point2 origin = origin_;
  Step step = reach(passage, place_at(sheet_, v));
  step.arrived = is_at(v, target);
  if (!step.arrived) origin_ = origin;
  return step;
}

/// The path runs along the edge of h towards its end v.
Step Walk::along(HalfEdge h, VertexIndex v, Point2 target) {
  const Point2 from = rest(sheet_.origin(h) == v ? sheet_.target(h) : sheet_.origin(h));
  const bool on_line = side(from, rest(v), target).sign == 0;
  if (is_at(v, target) || dot(target - rest(v), on_line ? rest(v) - from : target - origin_) > 0)
    return pass_vertex(along_edge(h), v, target);
  for (const bool to_edge : {false, true})
    for (const HalfEdge exit : {sheet_.opposite(h), h})
      if (exit.valid() && !(to_edge && attracts(h)) && shortest_way({exit}, target, to_edge).valid())
        return arrive_on(along_edge(h), exit, target);
  return reach(along_edge(h), place_on(h, target));
}

/// The line leaves through half-edge `exit`, whose origin lies to its right and whose target to its left.
Step Walk::leave(HalfEdge exit, double right, double left, Passage passage) {
  const Point2 a = rest(sheet_.origin(exit)), b = rest(sheet_.target(exit));
  Place place;
  place.kind = Place::Kind::edge;
  place.edge = exit;
  place.point = divide(a, b, std::abs(right), std::abs(left), place.lambda);
  at_ = place;
  crossing_ = true;
  entry_ = sheet_.opposite(exit);
  left_ = left;
  right_ = right;
  return {passage, place, false};
}

/// From the edge of a sliver, the line meets its others behind the place where it begins: then it leaves there.
bool Walk::is_behind(Point2 p, Point2 target) const {
  const Point2 line = target - origin_;
  return dot(p - origin_, line) < -line_tolerance * snap_ * std::max(std::abs(line.x), std::abs(line.y));
}

Step Walk::leave_at_origin(HalfEdge exit) {
  at_ = place_on(exit, origin_);
  crossing_ = false;
  return {through_face(triangle_of(exit)), at_, false};
}

/// The line has come in through `entry`, whose origin lies to its left and whose target to its right.
Step Walk::through(HalfEdge entry, double left, double right, Point2 target) {
  const TriangleIndex t = triangle_of(entry);
  const HalfEdge to_apex = Sheet::next(entry), from_apex = Sheet::previous(entry);
  const VertexIndex apex = sheet_.origin(from_apex);
  const Point2 w = rest(apex);
  const Side s = side(origin_, target, w);
  if (s.sign == 0) {
    if (!is_at(apex, target) && dot(target - w, target - origin_) < 0) return arrive(t, target);
    if (!is_behind(w, target)) return pass_vertex(through_face(t), apex, target);
    for (const HalfEdge exit : {to_apex, from_apex})
      if (lies_on(exit, origin_)) return leave_at_origin(exit);
    throw WalkLost();
  }
  const HalfEdge exit = s.sign > 0 ? to_apex : from_apex, other = s.sign > 0 ? from_apex : to_apex;
  if (const int beyond = side(rest(sheet_.origin(exit)), rest(sheet_.target(exit)), target).sign; beyond >= 0) {
    const bool clear = beyond > 0 && side(rest(sheet_.origin(entry)), rest(sheet_.target(entry)), target).sign > 0;
    return clear ? arrive_behind(other, target) : arrive(t, target);
  }
  return s.sign > 0 ? leave(exit, right, s.distance, through_face(t)) : leave(exit, s.distance, left, through_face(t));
}

Step Walk::from_face(TriangleIndex t, Point2 target) {
  std::array<Side, 3> beyond, lateral;
  bool inside = true, clear = true;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    const auto i = to_size(k);
    beyond[i] = side(rest(sheet_.origin(h)), rest(sheet_.target(h)), target);
    inside &= beyond[i].sign >= 0;
    clear &= beyond[i].sign > 0;
  }
  if (clear) return reach(through_face(t), place_in(t, target));
  if (inside) return arrive(t, target);
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexIndex v = sheet_.triangle(t).vertex[k];
    lateral[k] = side(origin_, target, rest(v));
    if (lateral[k].sign == 0 && ahead(rest(v), target)) return pass_vertex(through_face(t), v, target);
  }
  for (int k = 0; k < 3; ++k) {
    const auto i = to_size(k), j = to_size(next_corner(k));
    if (lateral[i].sign < 0 && lateral[j].sign > 0 && beyond[i].sign < 0)
      return leave(half_edge(t, k), lateral[i].distance, lateral[j].distance, through_face(t));
  }
  throw WalkLost();
}

Step Walk::from_edge(Place at, Point2 target) {
  HalfEdge h = at.edge;
  const Side s = side(rest(sheet_.origin(h)), rest(sheet_.target(h)), target);
  const auto end = [&](bool forward) { return forward ? sheet_.target(h) : sheet_.origin(h); };
  if (s.sign == 0)
    return along(h, end(dot(target - at.point, rest(sheet_.target(h)) - rest(sheet_.origin(h))) > 0), target);
  if (s.sign < 0) h = sheet_.opposite(h);
  if (!h.valid()) return outside_from_ = 0, from_outside(target);
  const Side left = side(origin_, target, rest(sheet_.origin(h))),
             right = side(origin_, target, rest(sheet_.target(h)));
  if (right.sign == 0 && ahead(rest(sheet_.target(h)), target)) return along(h, sheet_.target(h), target);
  if (left.sign == 0 && ahead(rest(sheet_.origin(h)), target)) return along(h, sheet_.origin(h), target);
  const Step step = through(h, left.distance, right.distance, target);
  const auto at_end = [&](VertexIndex v) { return near(step.place.point, rest(v)); };
  if (const HalfEdge exit = step.place.edge;
      crossing_ && lies_on(exit, origin_) &&
      (is_behind(step.place.point, target) || at_end(sheet_.origin(exit)) || at_end(sheet_.target(exit))))
    return leave_at_origin(exit);
  return step;
}

Step Walk::from_vertex(VertexIndex v, Point2 target) {
  if (is_at(v, target)) return reach({}, place_at(sheet_, v));
  if (within(rest(v), target, direction_tolerance * snap_))
    origin_ = rest(v);  // so near, the target may lie behind the line's origin
  const HalfEdge first = sheet_.first_outgoing(v);
  // Along an outgoing edge? At a border vertex the last one has no half-edge out of v, but its triangle's edge into v.
  // A vertex that is nearly here tells nothing of the way, unless it lies on it exactly.
  const auto lies_on_line = [&](VertexIndex x) {
    if (near(rest(x), target)) return true;
    const Point2 outgoing = rest(x) - rest(v);
    if (dot(outgoing, target - origin_) <= 0) return false;
    return squared_length(outgoing) > direction_tolerance * direction_tolerance * snap_ * snap_
               ? side(origin_, target, rest(x)).sign == 0
               : orientation(rest(v), target, rest(x)) == 0;
  };
  HalfEdge h = first;
  do {
    if (lies_on_line(sheet_.target(h))) return along(h, sheet_.target(h), target);
    const HalfEdge into = Sheet::previous(h);
    h = sheet_.next_outgoing(h);
    if (!h.valid() && lies_on_line(sheet_.origin(into))) return along(into, sheet_.origin(into), target);
  } while (h.valid() && h != first);
  // Into the triangle whose outgoing edges have the target between them.
  const auto leads_through = [&](HalfEdge exit) {
    return orientation(origin_, target, rest(sheet_.origin(exit))) < 0 &&
           orientation(origin_, target, rest(sheet_.target(exit))) > 0;
  };
  const auto enter = [&](HalfEdge exit) {
    const TriangleIndex t = triangle_of(exit);
    const Point2 a = rest(sheet_.origin(exit)), b = rest(sheet_.target(exit));
    if (side(a, b, target).sign >= 0) return arrive(t, target);
    const Step step =
        leave(exit, side(origin_, target, a).distance, side(origin_, target, b).distance, through_face(t));
    if (near(step.place.point, a)) return along(Sheet::previous(exit), sheet_.origin(exit), target);
    if (near(step.place.point, b)) return along(Sheet::next(exit), sheet_.target(exit), target);
    return step;
  };
  HalfEdge last = h = first;
  do {
    last = h;
    if (leads_through(Sheet::next(h))) return enter(Sheet::next(h));
    h = sheet_.next_outgoing(h);
  } while (h.valid() && h != first);
  // The line misses all triangles here: it leaves the sheet, or they are narrower than the snap distance. Then the rest
  // of it starts here, unless it leads exactly through a vertex nearly here where it meets an incision or the border.
  HalfEdge to_met;
  VertexIndex met;
  const auto look_at = [&](HalfEdge outgoing, VertexIndex x) {
    bool separates = false;
    for_each_separating_end(sheet_, x, [&](VertexIndex) { separates = true; });
    if (separates && orientation(origin_, target, rest(x)) == 0 && dot(rest(x) - rest(v), target - origin_) > 0) {
      to_met = outgoing;
      met = x;
    }
  };
  for_each_outgoing(sheet_, v, [&](HalfEdge outgoing) {
    look_at(outgoing, sheet_.target(outgoing));
    if (const HalfEdge into = Sheet::previous(outgoing); sheet_.on_border(into)) look_at(into, sheet_.origin(into));
  });
  if (to_met.valid()) return along(to_met, met, target);
  const Point2 origin = std::exchange(origin_, rest(v));
  h = first;
  do {
    const Point2 a = rest(sheet_.target(h));
    if (orientation(origin_, target, a) == 0 && ahead(a, target)) return along(h, sheet_.target(h), target);
    if (leads_through(Sheet::next(h))) return enter(Sheet::next(h));
    h = sheet_.next_outgoing(h);
  } while (h.valid() && h != first);
  if (h.valid()) throw WalkLost();
  origin_ = origin;
  // Out of the sheet, by no more than what still lies on the border?
  for (const HalfEdge border : {first, Sheet::previous(last)}) {
    const VertexIndex end = sheet_.origin(border) == v ? sheet_.target(border) : sheet_.origin(border);
    const Point2 edge = rest(end) - rest(v);
    const double along_edge_by = dot(target - rest(v), edge);
    if (side(rest(v), rest(end), target).sign == 0 && along_edge_by > 0 && along_edge_by < squared_length(edge))
      return along(border, end, target);
  }
  const Point2 line = target - origin_;
  outside_from_ = dot(rest(v) - origin_, line) / squared_length(line);
  return from_outside(target);
}

/// The first border edge or vertex on the line after `outside_from_`.
Step Walk::from_outside(Point2 target) {
  const Point2 line = target - origin_;
  const double length2 = dot(line, line), margin = snap_ / std::sqrt(length2);
  const bool begins = at_.kind == Place::Kind::edge && outside_from_ == 0;
  double best = 2;
  HalfEdge best_edge;
  VertexIndex best_vertex;
  std::optional<Place> at_target;  // on the border, where the line comes no nearer to it on the way
  // Two pieces that touch in one point have a vertex each there: from one the line may lead straight into the other; so
  // it may from one side of a notch into the other.
  const auto touches_at = [&](VertexIndex v) {
    if (at_.kind == Place::Kind::vertex) return v != at_.vertex && rest(v) == at_.point;
    if (at_.kind != Place::Kind::edge || !within(rest(v), at_.point, direction_tolerance * snap_)) return false;
    return rest(v) == rest(sheet_.origin(at_.edge)) || rest(v) == rest(sheet_.target(at_.edge));
  };
  const auto goes_on_at = [&](VertexIndex v) {
    if (!touches_at(v)) return false;
    HalfEdge h = sheet_.first_outgoing(v);
    for (; h.valid(); h = sheet_.next_outgoing(h))
      if (orientation(origin_, target, rest(sheet_.target(h))) <= 0 &&
          orientation(origin_, target, rest(sheet_.origin(Sheet::previous(h)))) >= 0)
        return true;
    return false;
  };
  auto try_vertex = [&](VertexIndex v, const Side& s) {
    const double at = dot(rest(v) - origin_, line) / length2;
    if (s.sign == 0 && at <= 1 + margin && at < best &&
        (at > outside_from_ + margin || (at >= outside_from_ - 2 * margin && goes_on_at(v)))) {
      best = at;
      best_edge = {};
      best_vertex = v;
    }
  };
  locator_.visit_border(
      sheet_, origin_, target,
      [&](HalfEdge h) {
        const VertexIndex u = sheet_.origin(h), v = sheet_.target(h);
        const auto off_target = [&](const Place& place) { return squared_length(place.point - target); };
        if (lies_on(h, target))
          if (const Place place = place_on(h, target); !at_target || off_target(place) < off_target(*at_target))
            at_target = place;
        const Side left = side(origin_, target, rest(u)), right = side(origin_, target, rest(v));
        try_vertex(u, left);
        try_vertex(v, right);
        if (left.sign <= 0 || right.sign >= 0) return;
        const Side from = side(rest(u), rest(v), origin_), to = side(rest(u), rest(v), target);
        // Where a line begins on several edges, as in a notch, it may leave through one and come in through the other.
        const bool comes_in = from.sign == 0 && begins && at_.edge != h && from.distance <= 0 && to.sign > 0;
        if (to.sign < 0 || (from.sign >= 0 && !comes_in)) return;
        const double at = from.distance / (from.distance - to.distance);
        if ((comes_in || at > outside_from_) && at < best) {
          best = at;
          best_edge = h;
          best_vertex = {};
        }
      },
      [&](double covered) { return best < covered; });
  if (best_vertex.valid()) return pass_vertex(outside, best_vertex, target);
  if (!best_edge.valid()) {
    if (at_target) return reach(outside, *at_target);
    Place place;
    place.point = target;
    return reach(outside, place);
  }
  const VertexIndex u = sheet_.origin(best_edge), v = sheet_.target(best_edge);
  if (side(rest(u), rest(v), target).sign == 0) return reach(outside, place_on(best_edge, target));
  const double left = side(origin_, target, rest(u)).distance, right = side(origin_, target, rest(v)).distance;
  Place place;
  place.kind = Place::Kind::edge;
  place.edge = best_edge;
  place.point = divide(rest(u), rest(v), std::abs(left), std::abs(right), place.lambda);
  at_ = place;
  crossing_ = true;
  entry_ = best_edge;
  left_ = left;
  right_ = right;
  return {outside, place, false};
}

Step Walk::advance(Point2 target, const Place* before) {
  before_ = before;
  Step step = joining_.valid() ? reach(through_face(std::exchange(joining_, {})), *before) : go_on(target);
  if (step.arrived && before && !are_together(sheet_, step.place, *before)) {
    joining_ = common_triangle(step.place, *before);
    step.arrived = !joining_.valid();
  }
  if (step.arrived) origin_ = target;  // not where it was snapped to, so that the way back is the way there
  return step;
}

/// A triangle that both lie in or on; none where they have none in common.
TriangleIndex Walk::common_triangle(const Place& a, const Place& b) const {
  TriangleIndex found;
  const auto look = [&](HalfEdge h) {
    if (h.valid() && touches(triangle_of(h), b)) found = triangle_of(h);
  };
  switch (a.kind) {
    case Place::Kind::face:
      look(half_edge(a.face, 0));
      break;
    case Place::Kind::edge:
      look(a.edge), look(sheet_.opposite(a.edge));
      break;
    case Place::Kind::vertex:
      for_each_outgoing(sheet_, a.vertex, look);
      break;
    case Place::Kind::outside:
      break;
  }
  return found;
}

/// Whether b is a corner of t or on an edge of it.
bool Walk::touches(TriangleIndex t, const Place& b) const {
  const auto& corners = sheet_.triangle(t).vertex;
  if (b.kind == Place::Kind::vertex) return std::find(corners.begin(), corners.end(), b.vertex) != corners.end();
  const HalfEdge o = sheet_.opposite(b.edge);
  return triangle_of(b.edge) == t || (o.valid() && triangle_of(o) == t);
}

Step Walk::go_on(Point2 target) {
  switch (at_.kind) {
    case Place::Kind::face:
      return from_face(at_.face, target);
    case Place::Kind::vertex:
      return from_vertex(at_.vertex, target);
    case Place::Kind::outside:
      outside_from_ = 0;
      return from_outside(target);
    case Place::Kind::edge:
      break;
  }
  if (beyond_.valid()) return arrive_beyond(std::exchange(beyond_, {}), target);
  if (!crossing_) return from_edge(at_, target);
  crossing_ = false;
  if (entry_.valid()) return through(entry_, left_, right_, target);
  const Point2 line = target - origin_;
  outside_from_ = dot(at_.point - origin_, line) / dot(line, line);
  return from_outside(target);
}

Place Walk::locate(Point2 p) {
  reach({}, place_at(sheet_, sheet_.triangle(locator_.near(sheet_, p)).vertex[0]));
  for (std::size_t steps = 0; !advance(p).arrived; ++steps)
    if (steps > 4 * sheet_.triangle_slots() + 100) throw WalkLost();
  return at_;
}

}  // namespace cutbench
