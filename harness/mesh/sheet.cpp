#include "harness/mesh/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

/// Weights of a triangle's corners, which add up to 1, for a point.
struct Weights {
  std::array<double, 3> of{};
  bool found = false;  ///< the weighted corners are where the point is, but for rounding
};

double largest_part(Point2 p) { return std::max(std::abs(p.x), std::abs(p.y)); }

/// Of the ends of the longest edge alone, which is all that doubles see of a triangle without an area.
Weights along_longest_edge(const std::array<Point2, 3>& c, Point2 p, double rounding) {
  std::size_t from = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (squared_length(c[(k + 1) % 3] - c[k]) > squared_length(c[(from + 1) % 3] - c[from])) from = k;
  const std::size_t to = (from + 1) % 3;
  const Point2 along = c[to] - c[from];
  const double t = dot(p - c[from], along) / squared_length(along);
  Weights weights;
  weights.of[from] = 1 - t;
  weights.of[to] = t;
  weights.found = largest_part(p - c[from] - t * along) <= rounding;
  return weights;
}

/// Barycentric coordinates of p in the triangle c: Cramer's rule. The rounding of an area that is nearly zero is as
/// large as that, so they are corrected by what they are off, until they say where p is.
Weights barycentric(const std::array<Point2, 3>& c, Point2 p) {
  constexpr int most_corrections = 8;
  const Point2 u = c[1] - c[0], v = c[2] - c[0], q = p - c[0];
  const double area = cross(u, v);
  const double rounding =
      2 * std::numeric_limits<double>::epsilon() * (largest_part(p) + largest_part(u) + largest_part(v));
  Weights weights;
  if (area > 0) {  // it is, by the exact predicate, but perhaps not in doubles
    double b = cross(q, v) / area, d = cross(u, q) / area;
    for (int i = 0; i < most_corrections && !weights.found; ++i) {
      const Point2 off = q - b * u - d * v;
      weights.found = largest_part(off) <= rounding;
      if (weights.found) continue;
      b += cross(off, v) / area;
      d += cross(u, off) / area;
    }
    weights.of = {1 - b - d, b, d};
  }
  return weights.found ? weights : along_longest_edge(c, p, rounding);
}

}  // namespace

std::array<Point2, 3> Sheet::corners(TriangleIndex t) const {
  const auto& v = triangle(t).vertex;
  return {rest(v[0]), rest(v[1]), rest(v[2])};
}

HalfEdge Sheet::first_outgoing(VertexIndex v) const {
  const TriangleIndex t = triangle_of_vertex(v);
  const auto& corner = triangle(t).vertex;
  const HalfEdge start = half_edge(t, corner[0] == v ? 0 : corner[1] == v ? 1 : 2);
  HalfEdge h = start;
  for (HalfEdge right = previous_outgoing(h); right.valid() && right != start; right = previous_outgoing(h)) h = right;
  return on_border(h) ? h : start;
}

// --- the log ---------------------------------------------------------------------------------------------------------

void Sheet::begin_cut() {
  auto recycle = [](auto& freed, auto& free) {
    free.insert(free.end(), freed.begin(), freed.end());
    freed.clear();
  };
  recycle(freed_triangles_, free_triangles_);
  recycle(freed_vertices_, free_vertices_);
  recycle(freed_deformed_, free_deformed_);
  vertex_of_freed_.clear();
  log_.clear();
  log_.triangles_before = triangles_.size();
  log_.vertices_before = rest_.size();
  log_.deformed_before = position_.size();
  if (work_.touched_in.size() < triangles_.size()) work_.touched_in.resize(triangles_.size());
  ++work_.epoch;
  ++cuts_begun_;
}

void Sheet::touch(TriangleIndex t) {
  if (t() >= log_.triangles_before || work_.touched_in[t()] == work_.epoch) return;
  work_.touched_in[t()] = work_.epoch;
  const Triangle& now = triangle(t);
  auto& entry = log_.touched.emplace_back(EditLog::Touched{t, now, {}});
  if (!now.alive()) return;
  for (std::size_t k = 0; k < 3; ++k) entry.vertex_triangle[k] = triangle_of_vertex(now.vertex[k]);
}

void Sheet::rollback() {
  // Backwards, so that what was logged first, the oldest state, is written last.
  for (auto moved = log_.moved.rbegin(); moved != log_.moved.rend(); ++moved) rest_[moved->vertex()] = moved->from;
  for (auto d = log_.displaced.rbegin(); d != log_.displaced.rend(); ++d) position_[d->vertex()] = d->from;
  for (std::size_t i = 0; i < freed_deformed_.size(); ++i)
    vertex_of_deformed_[freed_deformed_[i]()] = vertex_of_freed_[i];
  for (auto d = log_.new_deformed.rbegin(); d != log_.new_deformed.rend(); ++d) {
    vertex_of_deformed_[(*d)()] = {};
    if ((*d)() < log_.deformed_before) free_deformed_.push_back(*d);
  }
  for (auto v = log_.new_vertices.rbegin(); v != log_.new_vertices.rend(); ++v) {
    triangle_of_vertex_[(*v)()] = {};
    if ((*v)() < log_.vertices_before) free_vertices_.push_back(*v);
  }
  for (auto entry = log_.touched.rbegin(); entry != log_.touched.rend(); ++entry) {
    at(entry->slot) = entry->before;
    if (!entry->before.alive()) {
      free_triangles_.push_back(entry->slot);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const auto i = to_size(k);
      triangle_of_vertex_[entry->before.vertex[i]()] = entry->vertex_triangle[i];
      // Neighbours were re-linked without being touched themselves.
      if (const HalfEdge o = entry->before.opposite[i]; o.valid())
        at(triangle_of(o)).opposite[corner(o)] = half_edge(entry->slot, k);
    }
  }
  triangles_.resize(log_.triangles_before);
  rest_.resize(log_.vertices_before);
  triangle_of_vertex_.resize(log_.vertices_before);
  born_in_.resize(log_.vertices_before);
  position_.resize(log_.deformed_before);
  vertex_of_deformed_.resize(log_.deformed_before);
  freed_triangles_.clear();
  freed_vertices_.clear();
  freed_deformed_.clear();
  vertex_of_freed_.clear();
  work_.pending.clear();
  log_.clear();
}

// --- slots -----------------------------------------------------------------------------------------------------------

TriangleIndex Sheet::new_triangle() {
  if (free_triangles_.empty()) {
    triangles_.emplace_back();
    return TriangleIndex(triangles_.size() - 1);
  }
  const TriangleIndex t = free_triangles_.back();
  free_triangles_.pop_back();
  touch(t);
  return t;
}

VertexIndex Sheet::new_rest_vertex(Point2 p) {
  VertexIndex v(rest_.size());
  if (free_vertices_.empty()) {
    rest_.push_back(p);
    triangle_of_vertex_.emplace_back();
    born_in_.emplace_back();
  } else {
    v = free_vertices_.back();
    free_vertices_.pop_back();
    rest_[v()] = p;
    if (v() < held_.size()) held_[v()] = 0;  // of the vertex that was here
  }
  born_in_[v()] = cuts_begun_;
  log_.new_vertices.push_back(v);
  if (v() >= work_.pending_of.size()) work_.pending_of.resize(std::max(rest_.capacity(), v() + 1));
  work_.pending_of[v()] = static_cast<std::uint32_t>(work_.pending.size());
  return v;
}

DeformedIndex Sheet::new_deformed(VertexIndex v, const std::array<DeformedIndex, 3>& parents,
                                  const std::array<double, 3>& weights) {
  Point3 x = weights[0] * position(parents[0]);
  if (parents[1].valid()) x = x + weights[1] * position(parents[1]);
  if (parents[2].valid()) x = x + weights[2] * position(parents[2]);
  DeformedIndex d(position_.size());
  if (free_deformed_.empty()) {
    position_.push_back(x);
    vertex_of_deformed_.push_back(v);
  } else {
    d = free_deformed_.back();
    free_deformed_.pop_back();
    position_[d()] = x;
    vertex_of_deformed_[d()] = v;
  }
  log_.new_deformed.push_back(d);
  log_.ancestry.push_back({d, parents, weights});
  return d;
}

DeformedIndex Sheet::copy_deformed(DeformedIndex d) { return new_deformed(rest_vertex(d), {d, {}, {}}, {1, 0, 0}); }

void Sheet::reserve(std::size_t triangles, std::size_t vertices, std::size_t deformed) {
  triangles_.reserve(triangles);
  rest_.reserve(vertices);
  triangle_of_vertex_.reserve(vertices);
  born_in_.reserve(vertices);
  position_.reserve(deformed);
  vertex_of_deformed_.reserve(deformed);
}

// --- new vertices ----------------------------------------------------------------------------------------------------

VertexIndex Sheet::new_vertex(HalfEdge h, double lambda, Point2 p) {
  auto on_side = [&](HalfEdge side, double fraction, VertexIndex v) {
    const auto& d = triangle(triangle_of(side)).deformed;
    const auto k = corner(side);
    return new_deformed(v, {d[k], d[k == 2 ? 0 : k + 1], {}}, {1 - fraction, fraction, 0});
  };
  const VertexIndex v = new_rest_vertex(p);
  Work::Pending pending{v, triangle_of(h), {}, on_side(h, lambda, v), {}, rest(target(h)) - rest(origin(h)), {}};
  if (mark(h) == EdgeMark::incision) {
    pending.right = triangle_of(opposite(h));
    pending.at_right = on_side(opposite(h), 1 - lambda, v);
  }
  work_.pending.push_back(pending);
  return v;
}

VertexIndex Sheet::new_vertex(TriangleIndex t, Point2 p) {
  const VertexIndex v = new_rest_vertex(p);
  work_.pending.push_back(
      {v, t, {}, new_deformed(v, std::array(triangle(t).deformed), barycentric(corners(t), p).of), {}, {}, {}});
  return v;
}

// --- editing calls made of it ----------------------------------------------------------------------------------------

VertexIndex Sheet::split_edge(HalfEdge h, double lambda, Point2 p) {
  const HalfEdge o = opposite(h);
  const EdgeMark m = mark(h);
  const VertexIndex a = origin(h), b = target(h), c = origin(previous(h));
  const VertexIndex v = new_vertex(h, lambda, p);
  ++log_.splits;
  const auto none = EdgeMark::none;
  if (!o.valid()) {
    const NewTriangle halves[] = {{{a, v, c}, 0, {}}, {{v, b, c}, 0, {}}};
    replace_cavity(std::array{triangle_of(h)}, halves);
    return v;
  }
  const VertexIndex d = origin(previous(o));
  const NewTriangle quarters[] = {{{a, v, c}, 0, {m, none, none}},
                                  {{v, b, c}, 0, {m, none, none}},
                                  {{b, v, d}, 1, {m, none, none}},
                                  {{v, a, d}, 1, {m, none, none}}};
  replace_cavity(std::array{triangle_of(h), triangle_of(o)}, quarters);
  return v;
}

VertexIndex Sheet::split_triangle(TriangleIndex t, Point2 p) {
  const auto [a, b, c] = triangle(t).vertex;
  const VertexIndex v = new_vertex(t, p);
  ++log_.splits;
  const NewTriangle thirds[] = {{{a, b, v}, 0, {}}, {{b, c, v}, 0, {}}, {{c, a, v}, 0, {}}};
  replace_cavity(std::array{t}, thirds);
  return v;
}

bool Sheet::flip(HalfEdge h) {
  const HalfEdge o = opposite(h);
  if (!o.valid() || mark(h) != EdgeMark::none) return false;
  const VertexIndex a = origin(h), b = target(h), c = origin(previous(h)), d = origin(previous(o));
  if (orientation(rest(d), rest(b), rest(c)) <= 0 || orientation(rest(a), rest(d), rest(c)) <= 0) return false;
  const NewTriangle turned[] = {{{a, d, c}, 0, {}}, {{d, b, c}, 1, {}}};
  replace_cavity(std::array{triangle_of(h), triangle_of(o)}, turned);
  ++log_.flips;
  return true;
}

void Sheet::hold(VertexIndex v) {
  if (held_.size() <= v()) held_.resize(rest_.size());
  held_[v()] = 1;
}

bool Sheet::move(VertexIndex v, Point2 to) {
  if (is_held(v)) return false;
  for (const HalfEdge h : outgoing_edges(*this, v))
    if (orientation(to, rest(target(h)), rest(origin(previous(h)))) <= 0) return false;
  // Each fan's deformed vertex follows the fan's own old map: interpolated in the triangle that holds the new place, or
  // comes nearest to holding it.
  auto& carried = work_.carried;
  carried.clear();
  for (const HalfEdge h : outgoing_edges(*this, v)) {
    const Triangle& t = triangle(triangle_of(h));
    touch(triangle_of(h));
    const DeformedIndex d = t.deformed[corner(h)];
    const auto w = barycentric(corners(triangle_of(h)), to);
    const double depth = w.found ? std::min({w.of[0], w.of[1], w.of[2]}) : -std::numeric_limits<double>::max();
    auto known =
        std::find_if(carried.begin(), carried.end(), [&](const Work::Carried& c) { return c.from.vertex == d; });
    if (known == carried.end())
      carried.push_back({{d, t.deformed, w.of}, depth});
    else if (depth > known->depth)
      *known = {{d, t.deformed, w.of}, depth};
  }
  log_.moved.push_back({v, rest(v)});
  rest_[v()] = to;
  for (const auto& [from, depth] : carried) {
    Point3 x;
    for (std::size_t i = 0; i < 3; ++i) x = x + from.weights[i] * position(from.parents[i]);
    log_.displaced.push_back({from.vertex, position(from.vertex)});
    log_.ancestry.push_back(from);
    position_[from.vertex()] = x;
  }
  return true;
}

void Sheet::free_vertex(VertexIndex v) {
  triangle_of_vertex_[v()] = {};
  freed_vertices_.push_back(v);
}

void Sheet::free_deformed(DeformedIndex d) {
  vertex_of_freed_.push_back(vertex_of_deformed_[d()]);
  vertex_of_deformed_[d()] = {};
  freed_deformed_.push_back(d);
}

bool Sheet::collapse(HalfEdge h) {
  const VertexIndex a = origin(h), b = target(h);
  if (is_held(a)) return false;
  HalfEdge onward;  // the other piece of the path at a
  HalfEdge outgoing = h;
  do {
    if (!outgoing.valid() || on_border(outgoing) || mark(outgoing) == EdgeMark::incision) return false;
    if (mark(outgoing) == EdgeMark::path && outgoing != h) {
      if (onward.valid()) return false;
      onward = outgoing;
    }
    outgoing = next_outgoing(outgoing);
  } while (outgoing != h);
  if ((mark(h) == EdgeMark::path) != onward.valid()) return false;
  const VertexIndex end = onward.valid() ? target(onward) : VertexIndex();

  auto& star = work_.star;
  auto& rest_of_star = work_.rest_of_star;
  star.clear();
  rest_of_star.clear();
  do {
    const VertexIndex c = target(outgoing), d = origin(previous(outgoing));
    if (c != b && d != b) {
      if (orientation(rest(b), rest(c), rest(d)) <= 0) return false;
      const auto mark_to = [&](VertexIndex v) { return v == end ? EdgeMark::path : EdgeMark::none; };
      rest_of_star.push_back({{b, c, d}, to_int(star.size()), {mark_to(c), EdgeMark::none, mark_to(d)}});
    } else if (c == end || d == end) {
      return false;
    }
    star.push_back(triangle_of(outgoing));
    outgoing = next_outgoing(outgoing);
  } while (outgoing != h);
  const DeformedIndex d = triangle(triangle_of(h)).deformed[corner(h)];
  replace_cavity(star, rest_of_star);
  drop_vertex(a, d);
  return true;
}

// --- small changes ---------------------------------------------------------------------------------------------------

void Sheet::set_mark(HalfEdge h, EdgeMark mark) {
  const HalfEdge o = opposite(h);
  if (!o.valid() || this->mark(h) == mark) return;
  touch(triangle_of(h));
  touch(triangle_of(o));
  at(triangle_of(h)).mark[corner(h)] = mark;
  at(triangle_of(o)).mark[corner(o)] = mark;
  if (mark != EdgeMark::path) return;
  put_on_path(origin(h));
  put_on_path(target(h));
}

void Sheet::set_deformed(TriangleIndex t, int corner, DeformedIndex d) {
  touch(t);
  at(t).deformed[to_size(corner)] = d;
}

}  // namespace cutbench
