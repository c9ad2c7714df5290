#include "harness/cut/embed_carefully.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

[[noreturn]] void give_up() {
  throw TooClose(
      "older cuts, or the path itself, leave strips here that are too thin for doubles; cut a little beside");
}

/// A chain of edges from `from` to `to`, given by its ends.
struct Chain {
  VertexIndex from, to;
};

class CarefulEmbedding {
 public:
  CarefulEmbedding(Sheet& sheet, const Subdivision& trace) : sheet_(sheet), trace_(trace), snap_(sheet.snap()) {}

  double run() {
    collect();
    for (const auto& [edge, first] : separating_) split_separating_edge(edge, first);
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
      if (vertex_[i].valid()) continue;
      const Point2 p = trace_.nodes[i].place.point;
      // Across a stack of slivers consecutive nodes may coincide: then they are one vertex.
      const bool again = i > 0 && within(p, rest(vertex_[i - 1]), snap_);
      vertex_[i] = again ? vertex_[i - 1] : insert(p, triangle_of_node_[i]);
    }
    const auto vertex_of = [&](int node) { return vertex_[to_size(node)]; };
    for (const auto& face : trace_.faces)  // the list of all segments has those that were replaced, too
      for (int s = face.segments; s >= 0; s = trace_.segment(s).next)
        connect(vertex_of(trace_.segment(s).from), vertex_of(trace_.segment(s).to));
    for (const auto& along : trace_.along) {
      const std::vector<int> stops = trace_.nodes_along(along);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) connect(vertex_of(stops[i]), vertex_of(stops[i + 1]));
    }
    return moved_;
  }

 private:
  Point2 rest(VertexIndex v) const { return sheet_.rest(v); }

  /// The half-edge from a to b, or from b to a where that is the only one; none where they are no neighbours.
  HalfEdge find_edge(VertexIndex a, VertexIndex b) const {
    const HalfEdge h = find_half_edge(sheet_, a, b);
    return h.valid() ? h : find_half_edge(sheet_, b, a);
  }

  /// The faces and edges of the trace are those of the sheet before any edit: what is needed of them is stored first.
  void collect() {
    vertex_.assign(trace_.nodes.size(), {});
    triangle_of_node_.assign(trace_.nodes.size(), {});
    for (std::size_t i = 0; i < trace_.nodes.size(); ++i) {
      const Place& at = trace_.nodes[i].place;
      if (at.kind == Place::Kind::vertex) vertex_[i] = at.vertex;
      triangle_of_node_[i] = at.kind == Place::Kind::edge ? triangle_of(at.edge) : at.face;
    }
    for (const auto& face : trace_.faces)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(face.triangle, k);
        const int first = face.on_edge[to_size(k)];
        if (first >= 0 && first_half_edge(sheet_, h) == h && sheet_.separates(h))
          separating_.push_back({{sheet_.origin(h), sheet_.target(h)}, first});
      }
  }

  /// Nodes on the border or on an incision stay on it.
  void split_separating_edge(Chain edge, int first) {
    for (int n = first; n >= 0; n = trace_.node(n).next) {
      const VertexIndex v = split(edge.from, edge.to, trace_.node(n).place.point);
      vertex_[to_size(n)] = v;
      if (v != edge.to) edge.from = v;
    }
  }

  /// A vertex at p on the edge a - b; the nearer end where that is within the snap distance, or where p would invert a
  /// triangle beside the edge.
  VertexIndex split(VertexIndex a, VertexIndex b, Point2 p) {
    const VertexIndex nearest = squared_length(p - rest(a)) < squared_length(p - rest(b)) ? a : b;
    if (within(p, rest(nearest), snap_)) return nearest;
    if (const HalfEdge h = make_room(a, b, p); h.valid()) {
      const Point2 from = rest(sheet_.origin(h)), along = rest(sheet_.target(h)) - from;
      return sheet_.split_edge(h, std::clamp(dot(p - from, along) / squared_length(along), 0.0, 1.0), p);
    }
    const double moved = std::sqrt(squared_length(p - rest(nearest)));
    if (moved > careful_move_tolerance * sheet_.mean_edge()) give_up();
    moved_ = std::max(moved_, moved);
    return nearest;
  }

  /// The edge a - b, after flips of slivers beside it that a vertex at p would invert; an invalid half-edge where a
  /// sliver's other edges may not be flipped.
  HalfEdge make_room(VertexIndex a, VertexIndex b, Point2 p) {
    for (int tries = 0; tries < 8; ++tries) {
      const HalfEdge h = find_edge(a, b);
      if (!h.valid()) give_up();
      HalfEdge tight = in_the_way(h, p);
      if (!tight.valid()) tight = in_the_way(sheet_.opposite(h), p);
      if (!tight.valid()) return h;
      if (!sheet_.flip(Sheet::next(tight)) && !sheet_.flip(Sheet::previous(tight))) return {};
    }
    return {};
  }

  /// The half-edge itself where a vertex at p on it would invert its triangle; otherwise an invalid one.
  HalfEdge in_the_way(HalfEdge h, Point2 p) const {
    if (!h.valid()) return {};
    const Point2 apex = rest(sheet_.origin(Sheet::previous(h)));
    const bool clear =
        orientation(rest(sheet_.origin(h)), p, apex) > 0 && orientation(p, rest(sheet_.target(h)), apex) > 0;
    return clear ? HalfEdge() : h;
  }

  /// A vertex at p, in the triangle or on the edge that holds it, or the one at the snap distance. `t`: near it.
  VertexIndex insert(Point2 p, TriangleIndex t) {
    t = locate(p, t);
    for (const VertexIndex v : sheet_.triangle(t).vertex)
      if (within(p, rest(v), snap_)) return v;
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(t, k); orientation(rest(sheet_.origin(h)), rest(sheet_.target(h)), p) == 0)
        return split(sheet_.origin(h), sheet_.target(h), p);
    return sheet_.split_triangle(t, p);
  }

  TriangleIndex locate(Point2 p, TriangleIndex t) const {
    for (std::size_t budget = 10000; budget > 0; --budget) {
      bool here = true;
      for (int k = 0; k < 3 && here; ++k) {
        const HalfEdge h = half_edge(t, k);
        if (orientation(rest(sheet_.origin(h)), rest(sheet_.target(h)), p) >= 0) continue;
        if (sheet_.separates(h)) give_up();
        t = triangle_of(sheet_.opposite(h));
        here = false;
      }
      if (here) return t;
    }
    give_up();
  }

  /// Makes a chain of marked edges from a to b.
  void connect(VertexIndex a, VertexIndex b) {
    targets_.assign(1, b);
    for (std::size_t budget = 1000; !targets_.empty(); --budget) {
      if (budget == 0) give_up();
      if (a == targets_.back())
        targets_.pop_back();
      else
        a = go_towards(a, targets_.back());
    }
  }

  /// Goes one edge towards the target, or sets a nearer target and stays.
  VertexIndex go_towards(VertexIndex a, VertexIndex target) {
    const auto side = [&](VertexIndex v) { return orientation(rest(a), rest(target), rest(v)); };
    const auto straight_on = [&](VertexIndex v) {
      return v == target || (side(v) == 0 && dot(rest(v) - rest(a), rest(target) - rest(a)) > 0);
    };
    for (const HalfEdge h : outgoing_edges(sheet_, a)) {
      const HalfEdge across = Sheet::next(h), into = Sheet::previous(h);
      if (straight_on(sheet_.target(h))) return take(h, sheet_.target(h));
      if (straight_on(sheet_.origin(into))) return take(into, sheet_.origin(into));
      if (side(sheet_.origin(across)) < 0 && side(sheet_.target(across)) > 0) return cross(a, target, across);
    }
    give_up();  // the straight way leaves the sheet
  }

  VertexIndex take(HalfEdge h, VertexIndex end) {
    if (!sheet_.separates(h)) sheet_.set_mark(h, EdgeMark::path);
    return end;
  }

  /// The way from a leads through half-edge h, from right to left.
  VertexIndex cross(VertexIndex a, VertexIndex target, HalfEdge h) {
    crossed_.clear();
    for (;;) {
      if (sheet_.separates(h)) {
        targets_.push_back(split(sheet_.origin(h), sheet_.target(h), intersection(a, target, h)));
        return a;
      }
      crossed_.push_back({sheet_.origin(h), sheet_.target(h)});
      const HalfEdge beyond = sheet_.opposite(h);
      const VertexIndex apex = sheet_.origin(Sheet::previous(beyond));
      if (apex == target) break;
      const int side = orientation(rest(a), rest(target), rest(apex));
      if (side == 0) {
        targets_.push_back(apex);
        return a;
      }
      h = side > 0 ? Sheet::next(beyond) : Sheet::previous(beyond);
    }
    flip_away(a, target);
    return a;
  }

  Point2 intersection(VertexIndex a, VertexIndex target, HalfEdge h) const {
    const Point2 line = rest(target) - rest(a), u = rest(sheet_.origin(h)), v = rest(sheet_.target(h));
    const double from_u = std::abs(cutbench::cross(line, u - rest(a)));
    const double from_v = std::abs(cutbench::cross(line, v - rest(a)));
    double lambda = 0;
    return divide(u, v, from_u, from_v, lambda);
  }

  /// Flips the crossed edges until none of them crosses a - b, which then is an edge.
  void flip_away(VertexIndex a, VertexIndex b) {
    const auto crosses = [&](const Chain& e) {
      if (e.from == a || e.from == b || e.to == a || e.to == b) return false;
      return orientation(rest(a), rest(b), rest(e.from)) * orientation(rest(a), rest(b), rest(e.to)) < 0 &&
             orientation(rest(e.from), rest(e.to), rest(a)) * orientation(rest(e.from), rest(e.to), rest(b)) < 0;
    };
    const std::size_t budget = 100 + 10 * crossed_.size() * crossed_.size();
    for (std::size_t i = 0; i < crossed_.size(); ++i) {
      if (i > budget) give_up();
      const Chain edge = crossed_[i];
      const HalfEdge h = find_edge(edge.from, edge.to);
      const Chain diagonal{sheet_.origin(Sheet::previous(h)), sheet_.origin(Sheet::previous(sheet_.opposite(h)))};
      if (!sheet_.flip(h))
        crossed_.push_back(edge);
      else if (crosses(diagonal))
        crossed_.push_back(diagonal);
    }
  }

  struct Separating {
    Chain edge;
    int first_node;
  };

  Sheet& sheet_;
  const Subdivision& trace_;
  double snap_, moved_ = 0;
  std::vector<VertexIndex> vertex_;              // per node
  std::vector<TriangleIndex> triangle_of_node_;  // of the sheet before: its first child has its slot
  std::vector<Separating> separating_;
  std::vector<VertexIndex> targets_;  // of connect(), the nearest last
  std::vector<Chain> crossed_;
};

}  // namespace

double embed_carefully(Sheet& sheet, const Subdivision& trace) { return CarefulEmbedding(sheet, trace).run(); }

}  // namespace cutbench
