// Arriving: which vertex, edge or triangle a corner of the path lies in. In a stack of slivers, which cuts upon cuts
// leave, several edges can lie within the snap distance of it; then the walk goes on through the slivers to a vertex or
// a separating edge, if there is one, so that the path meets older incisions and the border where it should.
#include <algorithm>
#include <utility>
#include <vector>

#include "harness/mesh/tolerances.h"
#include "harness/path/walk.h"

namespace cutbench {

/// Whether p lies on the edge, or past its end no farther than `line_tolerance` from there.
bool Walk::lies_on(HalfEdge h, Point2 p) const {
  const Point2 a = rest(sheet_.origin(h)), b = rest(sheet_.target(h)), ab = b - a;
  if (side(a, b, p).sign != 0) return false;
  if (dot(p - a, ab) < 0) return squared_length(p - a) <= line_tolerance * line_tolerance * snap_ * snap_;
  if (dot(b - p, ab) < 0) return squared_length(p - b) <= line_tolerance * line_tolerance * snap_ * snap_;
  return true;
}

Place Walk::place_on(HalfEdge h, Point2 p) const {
  const Point2 a = rest(sheet_.origin(h)), ab = rest(sheet_.target(h)) - a;
  Place place;
  place.kind = Place::Kind::edge;
  place.edge = h;
  const double from_a = std::max(0.0, dot(p - a, ab)), from_b = std::max(0.0, dot(rest(sheet_.target(h)) - p, ab));
  place.point = divide(a, rest(sheet_.target(h)), from_a, from_b, place.lambda);
  if (near(place.point, a)) return place_at(sheet_, sheet_.origin(h));
  if (near(place.point, rest(sheet_.target(h)))) return place_at(sheet_, sheet_.target(h));
  return place;
}

/// \pre p lies in t, or within the snap distance of it.
Place Walk::classify(TriangleIndex t, Point2 p) const {
  const Triangle& triangle = sheet_.triangle(t);
  for (auto v : triangle.vertex)
    if (is_at(v, p)) return place_at(sheet_, v);
  HalfEdge on;  // in a corner so thin that two edges are that near: the border or an incision, else the second
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (lies_on(h, p) && (!on.valid() || !attracts(on))) on = h;
  }
  return on.valid() ? place_on(on, p) : place_in(t, p);
}

/// \pre the target lies to the left of the edges of t, or within twice the snap distance of their lines.
Step Walk::arrive(TriangleIndex t, Point2 target) {
  // Past the tip of a thin corner it does so, too: then the tip lies that near to the way.
  const auto is_past = [&](VertexIndex from, VertexIndex end) {
    const Point2 edge = rest(end) - rest(from);
    return dot(target - rest(end), edge) > 0 && side(rest(from), rest(end), target).sign == 0 &&
           !(at_.kind == Place::Kind::vertex && at_.vertex == end);
  };
  const auto edge = [t](int k) { return half_edge(t, k); };
  if (!lies_on(edge(0), target) && !lies_on(edge(1), target) && !lies_on(edge(2), target))
    for (int k = 0; k < 3; ++k) {
      const VertexIndex a = sheet_.origin(edge(k)), b = sheet_.target(edge(k));
      if (is_past(a, b)) return pass_vertex(through_face(t), b, target);
      if (is_past(b, a)) return pass_vertex(through_face(t), a, target);
    }
  const Place place = classify(t, target);
  if (place.kind == Place::Kind::vertex && is_detour(place.vertex, target))
    return pass_vertex(through_face(t), place.vertex, target);
  if (place.kind == Place::Kind::edge)
    if (const HalfEdge exit = way_to_better({edge(0), edge(1), edge(2)}, target, !attracts(place.edge)); exit.valid())
      return arrive_on(through_face(t), exit, target);
  return reach(through_face(t), place);
}

/// A vertex at which the target was found because of an edge, though it is farther than the snap distance: there may be
/// a nearer one beyond it, where the walk hasn't looked yet.
bool Walk::is_detour(VertexIndex v, Point2 target) const {
  const Point2 from = at_.point - target;
  return !is_at(v, target) && !(at_.kind == Place::Kind::vertex &&
                                std::max(std::abs(from.x), std::abs(from.y)) <= meeting_tolerance * snap_);
}

/// Is there a vertex at p, also behind an incision that it lies on, too, or else, where `edges_too`, an edge that
/// attracts it, on the other side of an edge that it lies on? There the slivers of earlier cuts may lie upon each
/// other, dozens of them where these were refined. Through which of the exits the way is shortest, breadth first;
/// invalid: there is none. Of several exits those count that p lies on.
HalfEdge Walk::way_to_better(std::initializer_list<HalfEdge> exits, Point2 p, bool edges_too) const {
  const HalfEdge to_vertex = shortest_way(exits, p, false);
  return to_vertex.valid() || !edges_too ? to_vertex : shortest_way(exits, p, true);
}

/// To a vertex, through incisions; or to an edge that attracts.
HalfEdge Walk::shortest_way(std::initializer_list<HalfEdge> exits, Point2 p, bool to_edge) const {
  struct Way {
    HalfEdge exit, entry;  // out of the first triangle, and into the one that it has come to
  };
  constexpr std::size_t most = 1024;
  std::vector<Way> ways;
  const TriangleIndex start = triangle_of(*exits.begin());
  const auto go = [&](HalfEdge exit, HalfEdge h) {
    const HalfEdge entry = sheet_.opposite(h);
    const auto is_there = [&](const Way& way) { return triangle_of(way.entry) == triangle_of(entry); };
    if (triangle_of(entry) == start || std::any_of(ways.begin(), ways.end(), is_there)) return;
    if (ways.size() == most && !to_edge) return;  // so far away it isn't missed
    if (ways.size() == most) throw WalkLost();
    ways.push_back({exit, entry});
  };
  const auto leads_on = [&](HalfEdge h) { return to_edge ? !sheet_.separates(h) : !sheet_.on_border(h); };
  for (const HalfEdge h : exits)
    if ((exits.size() == 1 || lies_on(h, p)) && leads_on(h)) go(h, h);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto [exit, entry] = ways[i];
    if (!to_edge && is_at(sheet_.origin(Sheet::previous(entry)), p)) return exit;
    for (const HalfEdge h : {Sheet::next(entry), Sheet::previous(entry)}) {
      if (!lies_on(h, p)) continue;
      if (to_edge && attracts(h)) return exit;
      if (leads_on(h)) go(exit, h);
    }
  }
  return {};
}

/// At the target, on an edge, but the walk goes on to the better place beyond it.
Step Walk::arrive_on(Passage passage, HalfEdge h, Point2 target) {
  Step step = reach(passage, place_on(h, target));
  if (step.place.kind != Place::Kind::edge) return step;
  beyond_ = sheet_.opposite(h);
  step.arrived = false;
  return step;
}

Step Walk::arrive_beyond(HalfEdge entry, Point2 target) {
  const Passage passage = through_face(triangle_of(entry));
  if (const VertexIndex apex = sheet_.origin(Sheet::previous(entry)); is_at(apex, target))
    return reach(passage, place_at(sheet_, apex));
  HalfEdge on;
  for (HalfEdge h : {Sheet::next(entry), Sheet::previous(entry)})
    if (lies_on(h, target) && attracts(h)) on = h;
  const HalfEdge exit = way_to_better({Sheet::next(entry), Sheet::previous(entry)}, target, !on.valid());
  if (exit.valid()) return arrive_on(passage, exit, target);
  return on.valid() ? reach(passage, place_on(on, target)) : throw WalkLost();
}

}  // namespace cutbench
