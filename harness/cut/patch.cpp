#include "harness/cut/patch.h"

#include <algorithm>
#include <optional>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

int orientation(const Patch& patch, int a, int b, int c) {
  const auto& p = patch.points;
  return cutbench::orientation(p[to_size(a)], p[to_size(b)], p[to_size(c)]);
}

using Segments = std::vector<std::array<int, 2>>;

/// Both ways, sorted; empty where there are so few that looking at each is as fast.
Segments both_ways(const Segments& segments) {
  if (segments.size() <= 16) return {};
  Segments all = segments;
  for (const auto& s : segments) all.push_back({s[1], s[0]});
  std::sort(all.begin(), all.end());
  return all;
}

bool is_segment(const Patch& patch, const Segments& all, int a, int b) {
  if (all.empty())
    return std::any_of(patch.segments.begin(), patch.segments.end(),
                       [&](const auto& s) { return (s[0] == a && s[1] == b) || (s[0] == b && s[1] == a); });
  return std::binary_search(all.begin(), all.end(), std::array{a, b});
}

bool is_of_ring(const Patch& patch, int a, int b) {
  const int i = patch.ring_position[to_size(a)], j = patch.ring_position[to_size(b)];
  return i >= 0 && j == (i + 1 == to_int(patch.ring.size()) ? 0 : i + 1);
}

/// Mark of edge a -> b of the answer.
EdgeMark mark_of(const Patch& patch, const Segments& all, int a, int b) {
  if (is_of_ring(patch, a, b)) return patch.ring_marks[to_size(patch.ring_position[to_size(a)])];
  return is_segment(patch, all, a, b) ? EdgeMark::path : EdgeMark::none;
}

/// Both on one edge of the triangle: a diagonal between them lies upon that edge, and passes what is between them there
/// only because it was rounded to the outside.
bool are_on_one_edge(const Patch& patch, int a, int b) {
  const auto edges = [&](int p) {
    if (patch.ring_position[to_size(p)] < 0) return 0;
    return p < 3 ? 1 << p | 1 << previous_corner(p) : 1 << patch.edge_of(p);
  };
  return (edges(a) & edges(b)) != 0;
}

}  // namespace

HalfEdge find_half_edge(const Sheet& sheet, VertexIndex from, VertexIndex to) {
  for (const HalfEdge h : outgoing_edges(sheet, from)) {
    if (sheet.target(h) == to) return h;
  }
  return {};
}

int Patch::edge_of(int point) const {
  int edge = -1;
  for (int i = 0; i <= ring_position[to_size(point)]; ++i)
    if (ring[to_size(i)] < 3) ++edge;
  return edge;
}

void make_vertices(Sheet& sheet, Subdivision& subdivision) {
  for (auto& node : subdivision.nodes) {
    if (node.vertex.valid()) continue;
    const Place& at = node.place;
    node.vertex = at.kind == Place::Kind::edge ? sheet.new_vertex(at.edge, at.lambda, at.point)
                                               : sheet.new_vertex(at.face, at.point);
  }
}

void make_patch(const Sheet& sheet, const Subdivision& subdivision, int f, Patch& patch) {
  const Subdivision::Face& face = subdivision.face(f);
  patch.triangle = face.triangle;
  patch.points.clear();
  patch.vertices.clear();
  patch.nodes.clear();
  patch.ring.clear();
  patch.ring_marks.clear();
  patch.path_order.clear();
  patch.segments.clear();
  for (auto v : sheet.triangle(face.triangle).vertex) {
    patch.points.push_back(sheet.rest(v));
    patch.vertices.push_back(v);
    patch.nodes.push_back(subdivision.node_at(v));
  }
  auto add = [&](int n) {
    const int local = to_int(patch.points.size());
    patch.points.push_back(subdivision.node(n).place.point);
    patch.vertices.push_back(subdivision.node(n).vertex);
    patch.nodes.push_back(n);
    patch.path_order.push_back(local);
    return local;
  };
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(face.triangle, k);
    patch.ring.push_back(k);
    const auto on_edge = to_index(patch.ring.size());
    for (int n = face.on_edge[to_size(k)]; n >= 0; n = subdivision.node(n).next) patch.ring.push_back(add(n));
    if (first_half_edge(sheet, h) != h) std::reverse(patch.ring.begin() + on_edge, patch.ring.end());
    patch.ring_marks.resize(patch.ring.size(), sheet.mark(h));
  }
  for (int n = face.inside; n >= 0; n = subdivision.node(n).next) add(n);

  patch.ring_position.assign(patch.points.size(), -1);
  for (std::size_t i = 0; i < patch.ring.size(); ++i) patch.ring_position[to_size(patch.ring[i])] = to_int(i);
  const auto node = [&](int local) { return patch.nodes[to_size(local)]; };
  std::sort(patch.path_order.begin(), patch.path_order.end(), [&](int a, int b) { return node(a) < node(b); });
  const auto local = [&](int n) {
    for (int k = 0; k < 3; ++k)
      if (node(k) == n) return k;
    return *std::lower_bound(patch.path_order.begin(), patch.path_order.end(), n,
                             [&](int a, int wanted) { return node(a) < wanted; });
  };
  for (int s = face.segments; s >= 0; s = subdivision.segment(s).next)
    patch.segments.push_back({local(subdivision.segment(s).from), local(subdivision.segment(s).to)});
}

bool find_crossing(const Sheet& sheet, const Subdivision& subdivision, int f, Crossing& crossing) {
  const Subdivision::Face& face = subdivision.face(f);
  if (face.edge_nodes != 2 || face.inside >= 0) return false;
  if (face.segments >= 0 && subdivision.segment(face.segments).next >= 0) return false;
  const auto& on = face.on_edge;
  const int free = on[0] < 0 ? 0 : on[1] < 0 ? 1 : 2;  // the edge without a node
  const int edge_q = previous_corner(free), edge_p = next_corner(free);
  const int p = on[to_size(edge_p)], q = on[to_size(edge_q)];
  if (p < 0 || q < 0) return false;
  if (face.segments >= 0) {
    const auto& s = subdivision.segment(face.segments);
    if (!(s.from == p && s.to == q) && !(s.from == q && s.to == p)) return false;
  }
  const Triangle& t = sheet.triangle(face.triangle);
  const auto corner = [&](int k) {
    const VertexIndex v = t.vertex[to_size(k)];
    return Crossing::Corner{v, sheet.rest(v)};
  };
  const auto node = [&](int n) {
    return Crossing::Corner{subdivision.node(n).vertex, subdivision.node(n).place.point};
  };
  crossing = {half_edge(face.triangle, edge_q),
              corner(edge_q),
              node(q),
              corner(free),
              corner(edge_p),
              node(p),
              p < q,
              face.segments >= 0 ? EdgeMark::path : EdgeMark::none};
  return true;
}

namespace {

[[noreturn]] void fail_inverted() {
  throw TooClose("a new triangle is not positive, its corners are too close for doubles");
}

}  // namespace

void split_crossing(Sheet& sheet, const Crossing& crossing, bool diagonal_from_p) {
  const Point2 apex = crossing.apex.point, p = crossing.p.point, q = crossing.q.point;
  const Point2 c = crossing.c.point, a = crossing.a.point;
  const bool positive = cutbench::orientation(apex, q, p) > 0 &&
                        cutbench::orientation(p, q, diagonal_from_p ? c : a) > 0 &&
                        cutbench::orientation(diagonal_from_p ? p : q, c, a) > 0;
  if (!positive) fail_inverted();
  sheet.cut_off_corner(crossing.edge, crossing.q.vertex, crossing.p.vertex, diagonal_from_p, crossing.path);
}

void append_answer(const Patch& patch, int parent, std::vector<Sheet::NewTriangle>& added) {
  std::size_t found = 0;  // half-edges that are segments
  const Segments all = both_ways(patch.segments);
  for (const auto& t : patch.triangles) {
    if (orientation(patch, t[0], t[1], t[2]) <= 0) fail_inverted();
    Sheet::NewTriangle made;
    made.parent = parent;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[k == 2 ? 0 : k + 1];
      made.vertex[k] = patch.vertices[to_size(a)];
      made.mark[k] = mark_of(patch, all, a, b);
      if (are_on_one_edge(patch, a, b) && !is_of_ring(patch, a, b) && !is_of_ring(patch, b, a))
        throw TooClose("an edge divided by the path would be one again");
      found += made.mark[k] == EdgeMark::path && is_segment(patch, all, a, b);
    }
    added.push_back(made);
  }
  if (patch.triangles.size() != patch.ring.size() - 2 + 2 * patch.inside_count() || found < 2 * patch.segments.size())
    throw TooClose("a triangle could not be subdivided along the path");
}

void mark_along(Sheet& sheet, const Subdivision& subdivision) {
  for (const auto& along : subdivision.along) {
    const std::vector<int> stops = subdivision.nodes_along(along);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const VertexIndex a = subdivision.node(stops[i]).vertex, b = subdivision.node(stops[i + 1]).vertex;
      const HalfEdge h = find_half_edge(sheet, a, b);
      if (h.valid() && sheet.mark(h) == EdgeMark::none) sheet.set_mark(h, EdgeMark::path);
      if (!h.valid() && !find_half_edge(sheet, b, a).valid())  // a border edge has one half-edge only
        throw TooClose("the path along an edge is not an edge of the result");
    }
  }
}

// --- moves on a patch's triangles ------------------------------------------------------------------------------------

PatchEdge find_edge(const Patch& patch, int a, int b) {
  for (std::size_t t = 0; t < patch.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (patch.triangles[t][k] == a && patch.triangles[t][k == 2 ? 0 : k + 1] == b) return {to_int(t), to_int(k)};
  return {};
}

void start_triangulation(Patch& patch) { patch.triangles.assign(1, {0, 1, 2}); }

namespace {

/// Splits the triangle with edge a -> b at p, which lies on it.
void split_side(Patch& patch, int a, int b, int p) {
  const PatchEdge e = find_edge(patch, a, b);
  if (e.triangle < 0) return;
  auto& t = patch.triangles[to_size(e.triangle)];
  const int c = t[to_size(previous_corner(e.corner))];
  t = {a, p, c};
  patch.triangles.push_back({p, b, c});
}

}  // namespace

void insert_on_ring(Patch& patch, int p) {
  // The nearest points of the ring, both ways, that are in the triangulation already.
  const auto inserted = [&](int q) {
    return std::any_of(patch.triangles.begin(), patch.triangles.end(),
                       [&](const auto& t) { return t[0] == q || t[1] == q || t[2] == q; });
  };
  const auto neighbour = [&](std::size_t step) {
    std::size_t i = to_size(patch.ring_position[to_size(p)]);
    do i = (i + step) % patch.ring.size();
    while (!inserted(patch.ring[i]));
    return patch.ring[i];
  };
  split_side(patch, neighbour(patch.ring.size() - 1), neighbour(1), p);
}

namespace {

/// +1 where p lies inside the triangle, 0 on its border, -1 outside.
int side_of(const Patch& patch, const std::array<int, 3>& t, int p) {
  int least = 1;
  for (std::size_t k = 0; k < 3 && least >= 0; ++k)
    least = std::min(least, orientation(patch, t[k], t[k == 2 ? 0 : k + 1], p));
  return least;
}

/// The triangle that holds p inside, most often one at the point before; none where p may lie on an edge.
std::optional<std::size_t> find_around(const Patch& patch, int p) {
  const int before = patch.triangles.back()[2];
  for (const bool at_it : {true, false})
    for (std::size_t i = patch.triangles.size(); i-- > 0;) {
      const auto& t = patch.triangles[i];
      if (at_it != (t[0] == before || t[1] == before || t[2] == before)) continue;
      if (const int side = side_of(patch, t, p); side >= 0) return side > 0 ? std::optional(i) : std::nullopt;
    }
  return {};
}

}  // namespace

void insert_inside(Patch& patch, int p) {
  for (std::size_t i = find_around(patch, p).value_or(0); i < patch.triangles.size(); ++i) {
    const auto [a, b, c] = patch.triangles[i];
    const std::array<int, 3> side{orientation(patch, a, b, p), orientation(patch, b, c, p),
                                  orientation(patch, c, a, p)};
    if (side[0] < 0 || side[1] < 0 || side[2] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (side[k] == 0) {
        const int from = patch.triangles[i][k], to = patch.triangles[i][k == 2 ? 0 : k + 1];
        split_side(patch, from, to, p);
        split_side(patch, to, from, p);
        return;
      }
    patch.triangles[i] = {a, b, p};
    patch.triangles.push_back({b, c, p});
    patch.triangles.push_back({c, a, p});
    return;
  }
  throw TooClose("a point of the path fell out of its triangle, coordinates too close for doubles");
}

namespace {

bool cross_properly(const Patch& patch, int a, int b, int c, int d) {
  if (c == a || c == b || d == a || d == b) return false;
  return orientation(patch, a, b, c) * orientation(patch, a, b, d) < 0 &&
         orientation(patch, c, d, a) * orientation(patch, c, d, b) < 0;
}

/// Puts the other diagonal, which it returns, in the place of edge a -> b; nothing unless the four corners are strictly
/// convex.
std::optional<std::array<int, 2>> flip(Patch& patch, int a, int b) {
  const PatchEdge e = find_edge(patch, a, b), o = find_edge(patch, b, a);
  if (e.triangle < 0 || o.triangle < 0) return {};
  auto& left = patch.triangles[to_size(e.triangle)];
  auto& right = patch.triangles[to_size(o.triangle)];
  const int c = left[to_size(previous_corner(e.corner))];
  const int d = right[to_size(previous_corner(o.corner))];
  if (orientation(patch, a, d, c) <= 0 || orientation(patch, d, b, c) <= 0) return {};
  if (are_on_one_edge(patch, c, d)) return {};
  left = {a, d, c};
  right = {d, b, c};
  return std::array{c, d};
}

std::vector<std::array<int, 2>> crossed_edges(const Patch& patch, int a, int b) {
  std::vector<std::array<int, 2>> edges;
  for (const auto& t : patch.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const int c = t[k], d = t[k == 2 ? 0 : k + 1]; c < d && cross_properly(patch, a, b, c, d))
        edges.push_back({c, d});
  return edges;
}

}  // namespace

int recover_segments(Patch& patch) {
  constexpr std::size_t most_work = 1'000'000'000;  // triangles looked at: seconds
  int missing = 0;
  std::size_t work = 0;
  for (const auto& [a, b] : patch.segments) {
    if (find_edge(patch, a, b).triangle >= 0 || find_edge(patch, b, a).triangle >= 0) continue;
    ++missing;
    std::vector<std::array<int, 2>> queue = crossed_edges(patch, a, b);
    const std::size_t budget = 100 + 10 * queue.size() * queue.size();
    for (std::size_t i = 0; i < queue.size(); ++i) {
      if (i > budget) throw TooClose("a path segment could not be recovered by flips");
      if ((work += patch.triangles.size()) > most_work)
        throw CutRefused("the path winds too much in one triangle; give it fewer points, or the sheet more triangles");
      const auto diagonal = flip(patch, queue[i][0], queue[i][1]);
      if (!diagonal)
        queue.push_back(queue[i]);
      else if (cross_properly(patch, a, b, (*diagonal)[0], (*diagonal)[1]))
        queue.push_back(*diagonal);
    }
  }
  return missing;
}

}  // namespace cutbench
