// How the sheet's triangles are replaced: slots, corners and neighbours of what comes in the place of a cavity.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// The deformed vertex, on the side of triangle `parent`, of a vertex made since the last replace_cavity().
DeformedIndex Sheet::pending_deformed(VertexIndex v, TriangleIndex parent) const {
  const auto i = v() < work_.pending_of.size() ? work_.pending_of[v()] : work_.pending.size();
  if (i >= work_.pending.size() || work_.pending[i].vertex != v) return {};
  const auto& made = work_.pending[i];
  if (!made.right.valid() || parent == made.left) return made.at_left;
  return parent == made.right ? made.at_right : DeformedIndex();
}

/// Makes h and o neighbours. What o is marked with counts.
void Sheet::link(HalfEdge h, HalfEdge o) {
  Triangle &left = at(triangle_of(h)), &right = at(triangle_of(o));
  left.opposite[corner(h)] = o;
  right.opposite[corner(o)] = h;
  const EdgeMark mark = left.mark[corner(h)] = right.mark[corner(o)];
  if (mark == EdgeMark::path) {
    put_on_path(origin(h));
    put_on_path(target(h));
  }
}

void Sheet::link_by_vertices(HalfEdge h) {
  if (const HalfEdge o = work_.edges.pair_or_insert(origin(h), target(h), h); o.valid()) link(h, o);
}

void Sheet::put_on_path(VertexIndex v) {
  if (v() >= work_.on_path_in.size()) work_.on_path_in.resize(std::max(rest_.capacity(), v() + 1));
  if (std::exchange(work_.on_path_in[v()], work_.epoch) != work_.epoch) log_.path_vertices.push_back(v);
}

/// The edge that the pending vertex v lies on became the half-edges `first` and `second`, in this order, on one side.
/// The side that comes second finds those of the first waiting.
void Sheet::join_halves(VertexIndex v, HalfEdge first, HalfEdge second) {
  auto& waiting = work_.pending[work_.pending_of[v()]].waiting;
  const auto connect = [&](HalfEdge h, HalfEdge o) {
    at(triangle_of(h)).opposite[corner(h)] = o;
    at(triangle_of(o)).opposite[corner(o)] = h;
  };
  if (!waiting[0].valid()) {
    waiting = {first, second};
  } else {
    connect(waiting[0], second);
    connect(waiting[1], first);
    waiting = {};
  }
}

void Sheet::cut_off_corner(HalfEdge apex, VertexIndex q, VertexIndex p, bool diagonal_from_p, EdgeMark mark) {
  const TriangleIndex corner_slot = triangle_of(apex);
  touch(corner_slot);
  const TriangleIndex middle = new_triangle(), last = new_triangle();
  const Triangle old = triangle(corner_slot);
  const std::size_t k = corner(apex), k_c = k == 2 ? 0 : k + 1, k_a = k == 0 ? 2 : k - 1;
  const VertexIndex o = old.vertex[k], c = old.vertex[k_c], a = old.vertex[k_a];
  const DeformedIndex d_c = old.deformed[k_c], d_a = old.deformed[k_a];
  const DeformedIndex d_q = pending_deformed(q, corner_slot), d_p = pending_deformed(p, corner_slot);
  const EdgeMark mark_q = old.mark[k], mark_ca = old.mark[k_c], mark_p = old.mark[k_a], none = EdgeMark::none;
  const HalfEdge outer = old.opposite[k_c];

  const HalfEdge later;  // the halves of split edges find their other sides below
  at(corner_slot) =
      Triangle{{o, q, p}, {later, half_edge(middle, 0), later}, {old.deformed[k], d_q, d_p}, {mark_q, mark, mark_p}};
  if (diagonal_from_p) {
    at(middle) = Triangle{
        {p, q, c}, {half_edge(corner_slot, 1), later, half_edge(last, 0)}, {d_p, d_q, d_c}, {mark, mark_q, none}};
    at(last) = Triangle{{p, c, a}, {half_edge(middle, 2), outer, later}, {d_p, d_c, d_a}, {none, mark_ca, mark_p}};
  } else {
    at(middle) = Triangle{
        {p, q, a}, {half_edge(corner_slot, 1), half_edge(last, 2), later}, {d_p, d_q, d_a}, {mark, none, mark_p}};
    at(last) = Triangle{{q, c, a}, {later, outer, half_edge(middle, 1)}, {d_q, d_c, d_a}, {mark_q, mark_ca, none}};
  }
  join_halves(q, half_edge(corner_slot, 0), diagonal_from_p ? half_edge(middle, 1) : half_edge(last, 0));
  join_halves(p, diagonal_from_p ? half_edge(last, 2) : half_edge(middle, 2), half_edge(corner_slot, 2));
  if (outer.valid()) at(triangle_of(outer)).opposite[corner(outer)] = half_edge(last, 1);
  triangle_of_vertex_[p()] = triangle_of_vertex_[q()] = corner_slot;
  triangle_of_vertex_[c()] = triangle_of_vertex_[a()] = last;
  if (mark == EdgeMark::path || mark_q == EdgeMark::path) put_on_path(q);
  if (mark == EdgeMark::path || mark_p == EdgeMark::path) put_on_path(p);
}

/// The deformed vertex of the fan that ends, clockwise, at `rightmost`, a piece of the opened incision that the pending
/// vertex at its origin lies on: the fan on the left of that edge ends at the piece that runs the edge's way.
DeformedIndex Sheet::pending_deformed_left_of(HalfEdge rightmost) const {
  const VertexIndex v = origin(rightmost);
  const auto i = v() < work_.pending_of.size() ? work_.pending_of[v()] : work_.pending.size();
  if (i >= work_.pending.size() || work_.pending[i].vertex != v) return {};
  const auto& made = work_.pending[i];
  return dot(rest(target(rightmost)) - rest(v), made.along) > 0 ? made.at_left : made.at_right;
}

/// The deformed vertex that v, an end of h, had before: h is an opened edge, or a piece of one that starts or ends with
/// v, and the old triangle on its left knows. Invalid where h is a piece in between.
DeformedIndex Sheet::old_deformed_beside(HalfEdge h, VertexIndex v, std::span<const TriangleIndex> removed) const {
  const VertexIndex from = origin(h), to = target(h), other = from == v ? to : from;
  const auto pending = other() < work_.pending_of.size() ? work_.pending_of[other()] : work_.pending.size();
  const bool is_piece = pending < work_.pending.size() && work_.pending[pending].vertex == other;
  TriangleIndex left;
  if (is_piece) {
    const auto& made = work_.pending[pending];
    left = dot(rest(to) - rest(from), made.along) > 0 ? made.left : made.right;
  }
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (is_piece && removed[i] != left) continue;
    const Triangle& t = work_.old[i];
    for (std::size_t k = 0; k < 3; ++k)
      if (t.vertex[k] == v && (is_piece || t.vertex[from == v ? (k + 1) % 3 : (k + 2) % 3] == other))
        return t.deformed[k];
  }
  return {};
}

/// Gives the corner at the origin of `outgoing edge` the deformed vertex that others of its fan have.
void Sheet::inherit_round(HalfEdge outgoing, std::span<const TriangleIndex> removed) {
  const auto known = [&](HalfEdge h) { return triangle(triangle_of(h)).deformed[corner(h)]; };
  DeformedIndex d;
  HalfEdge leftmost, rightmost;  // where the fan ends at opened edges
  for (HalfEdge h = outgoing; h.valid() && !d.valid();) {
    if (mark(previous(h)) == EdgeMark::incision) {
      leftmost = previous(h);
      break;
    }
    h = next_outgoing(h);
    if (h == outgoing) break;
    if (h.valid()) d = known(h);
  }
  for (HalfEdge h = outgoing; h.valid() && !d.valid();) {
    if (mark(h) == EdgeMark::incision) {
      rightmost = h;
      d = pending_deformed_left_of(h);
      break;
    }
    h = previous_outgoing(h);
    if (h == outgoing) break;
    if (h.valid()) d = known(h);
  }
  // All triangles of the fan were replaced: the old ones beside the opened edges know, else the one in whose corner
  // this one lies.
  for (const HalfEdge end : {leftmost, rightmost})
    if (end.valid() && !d.valid()) d = old_deformed_beside(end, origin(outgoing), removed);
  if (!d.valid()) {
    const auto c = corners(triangle_of(outgoing));
    const Point2 v = rest(origin(outgoing)), inward = c[0] + c[1] + c[2] - 3 * v;
    double deepest = -1e300;
    for (const Triangle& t : work_.old)
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.vertex[k] != origin(outgoing)) continue;
        const Point2 right = rest(t.vertex[k == 2 ? 0 : k + 1]) - v, left = rest(t.vertex[k == 0 ? 2 : k - 1]) - v;
        const double depth = std::min(cross(right, inward) / std::sqrt(squared_length(right)),
                                      cross(inward, left) / std::sqrt(squared_length(left)));
        if (depth > deepest) {
          deepest = depth;
          d = t.deformed[k];
        }
      }
  }
  at(triangle_of(outgoing)).deformed[corner(outgoing)] = d;
}

/// Fills a slot, with what its parent knows: deformed vertices, and neighbours across edges that stay as they were.
void Sheet::add_triangle(TriangleIndex slot, const NewTriangle& made, std::span<const TriangleIndex> removed) {
  const Triangle* old = made.parent >= 0 ? &work_.old[to_size(made.parent)] : nullptr;
  const TriangleIndex parent = old ? removed[to_size(made.parent)] : TriangleIndex();
  Triangle& t = at(slot);
  t.vertex = made.vertex;
  t.mark = made.mark;
  t.opposite = {};
  std::array<int, 3> corner_of_parent{-1, -1, -1};
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexIndex v = t.vertex[k];
    if (old) corner_of_parent[k] = old->vertex[0] == v ? 0 : old->vertex[1] == v ? 1 : old->vertex[2] == v ? 2 : -1;
    t.deformed[k] =
        corner_of_parent[k] >= 0 ? old->deformed[to_size(corner_of_parent[k])] : pending_deformed(v, parent);
    if (!t.deformed[k].valid()) work_.unassigned.push_back(half_edge(slot, to_int(k)));
    triangle_of_vertex_[v()] = slot;
  }
  for (int k = 0; k < 3; ++k) {
    const auto i = to_size(k);
    const HalfEdge h = half_edge(slot, k);
    const int from = corner_of_parent[i], to = corner_of_parent[to_size(next_corner(k))];
    if (from >= 0 && to == next_corner(from)) {
      const HalfEdge o = old->opposite[to_size(from)];
      if (!o.valid()) continue;
      if (was_removed(o))
        link_by_vertices(h);
      else
        link(h, o);
    } else {
      link_by_vertices(h);
    }
  }
}

void Sheet::replace_cavity(std::span<const TriangleIndex> removed, std::span<const NewTriangle> added) {
  auto& old = work_.old;
  auto& slot = work_.slot;
  auto& claimed = work_.claimed;
  old.clear();
  slot.resize(added.size());
  work_.unassigned.clear();
  claimed.assign(removed.size(), 0);
  work_.edges.reset(3 * (removed.size() + added.size()) + 2 * work_.pending.size());
  if (work_.removed_in.size() < triangles_.size()) work_.removed_in.resize(triangles_.capacity());
  ++work_.call;
  for (auto t : removed) {
    touch(t);
    old.push_back(triangle(t));
    at(t).vertex[0] = {};
    work_.removed_in[t()] = work_.call;
  }
  // Neighbours outside lose their opposite; those that stay unlinked are looked up below. What cut_off_corner() made of
  // a neighbour does not point back: its halves wait to be found.
  for (std::size_t i = 0; i < old.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      HalfEdge& o = old[i].opposite[to_size(k)];
      if (!o.valid() || was_removed(o)) continue;
      if (opposite(o) == half_edge(removed[i], k))
        at(triangle_of(o)).opposite[corner(o)] = {};
      else
        o = {};
    }
  if (!removed.empty())
    for (const auto& made : work_.pending)
      for (const HalfEdge half : made.waiting)
        if (half.valid()) link_by_vertices(half);

  // First children take their parents' slots, others what is left of the removed ones, then new ones.
  std::size_t unclaimed = 0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    const int p = added[i].parent;
    const bool first = p >= 0 && !claimed[to_size(p)];
    slot[i] = first ? removed[to_size(p)] : TriangleIndex();
    if (first) claimed[to_size(p)] = 1;
  }
  for (std::size_t i = 0; i < added.size(); ++i) {
    while (!slot[i].valid() && unclaimed < removed.size())
      if (const std::size_t j = unclaimed++; !claimed[j]) {
        slot[i] = removed[j];
        claimed[j] = 1;
      }
    if (!slot[i].valid()) slot[i] = new_triangle();
  }
  for (std::size_t i = 0; i < added.size(); ++i) add_triangle(slot[i], added[i], removed);
  for (std::size_t j = 0; j < removed.size(); ++j)
    if (!claimed[j]) freed_triangles_.push_back(removed[j]);
  for (const Triangle& t : old)
    for (const HalfEdge o : t.opposite)
      if (o.valid() && !was_removed(o) && !opposite(o).valid())
        if (const HalfEdge inner = work_.edges.pair_or_insert(origin(o), target(o), o); inner.valid()) link(inner, o);

  for (auto outgoing : work_.unassigned) inherit_round(outgoing, removed);
  work_.pending.clear();
}

}  // namespace cutbench
