#include "methods/tools/path_graph.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/path/tips.h"

namespace cutbench {

namespace {

bool in_closed_triangle(Point2 a, Point2 b, Point2 c, Point2 p) {
  const int x = orientation(a, b, p), y = orientation(b, c, p), z = orientation(c, a, p);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

/// The edge of t that two places lie on; none where there is no such edge.
HalfEdge common_edge(const Sheet& sheet, TriangleIndex t, const Place& a, const Place& b) {
  const auto lies_on = [&](const Place& place, HalfEdge h) {
    if (place.kind == Place::Kind::vertex) return place.vertex == sheet.origin(h) || place.vertex == sheet.target(h);
    return place.kind == Place::Kind::edge && (place.edge == h || place.edge == sheet.opposite(h));
  };
  for (int k = 0; k < 3; ++k)
    if (const HalfEdge h = half_edge(t, k); lies_on(a, h) && lies_on(b, h)) return h;
  return {};
}

}  // namespace

// --- reading and writing ---------------------------------------------------------------------------------------------

void PathGraph::read(const Sheet& sheet, const Subdivision& trace) {
  sheet_ = &sheet;
  trace_ = &trace;
  nodes_.clear();
  pieces_.clear();
  taken_.clear();
  for (const auto& node : trace.nodes) nodes_.push_back({node.place, 0, {-1, -1}, false});
  for (const auto& face : trace.faces)
    for (int s = face.segments; s >= 0; s = trace.segment(s).next)
      add_piece(trace.segment(s).from, trace.segment(s).to, face.triangle, {});
  for (const auto& along : trace.along) add_along(along);
}

/// Once, though the path may go to and fro.
void PathGraph::add_piece(int from, int to, TriangleIndex triangle, HalfEdge edge) {
  for (const int known : at(from).piece)
    if (known >= 0 && other_end(known, from) == to && piece(known).triangle == triangle) return;
  for (const int node : {from, to}) {
    Node& n = nodes_[to_size(node)];
    if (n.degree < 2) n.piece[to_size(n.degree)] = to_int(pieces_.size());
    ++n.degree;
  }
  pieces_.push_back({from, to, triangle, edge, false});
}

/// From node to node: another passage may cross the edge in between.
void PathGraph::add_along(const Subdivision::Along& along) {
  const std::vector<int> stops = trace_->nodes_along(along);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) add_piece(stops[i], stops[i + 1], {}, along.edge);
}

void PathGraph::write(Subdivision& trace) const {
  trace.reset(*sheet_);
  std::vector<int> number(nodes_.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (!nodes_[i].gone) number[i] = trace.add_node(nodes_[i].place);
  for (const Piece& piece : pieces_) {
    if (piece.gone) continue;
    const int from = number[to_size(piece.from)], to = number[to_size(piece.to)];
    const HalfEdge edge = piece.triangle.valid()
                              ? common_edge(*sheet_, piece.triangle, at(piece.from).place, at(piece.to).place)
                              : piece.edge;
    if (edge.valid())
      trace.add_along(from, to, edge);
    else
      trace.add_segment(trace.face_of(piece.triangle), from, to);
  }
}

// --- looking round a vertex ------------------------------------------------------------------------------------------

int PathGraph::other_end(int i, int node) const { return piece(i).from == node ? piece(i).to : piece(i).from; }

double PathGraph::fraction_from(VertexIndex v, const Place& place) const {
  return sheet_->origin(place.edge) == v ? place.lambda : 1 - place.lambda;
}

/// A plain crossing of an edge, or the path's end on the border or an older incision. Not on a seam: beyond it the path
/// is another graph, which must meet this one.
bool PathGraph::may_move(int node) const {
  const Node& n = at(node);
  if (n.gone || n.place.kind != Place::Kind::edge) return false;
  if (n.degree == 1)
    return sheet_->separates(n.place.edge) && !(sheet_->on_border(n.place.edge) && is_on_seam(*sheet_, n.place.edge));
  if (n.degree != 2 || sheet_->on_border(n.place.edge)) return false;
  return piece(n.piece[0]).triangle != piece(n.piece[1]).triangle;
}

std::vector<PathGraph::Approach> PathGraph::approaches(double reach) const {
  std::vector<Approach> found;
  for (int i = 0; i < to_int(nodes_.size()); ++i) {
    if (!may_move(i)) continue;
    const Place& place = at(i).place;
    const bool first = place.lambda <= 0.5;
    const double fraction = first ? place.lambda : 1 - place.lambda;
    if (fraction <= reach && reach > 0)
      found.push_back({i, first ? sheet_->origin(place.edge) : sheet_->target(place.edge), fraction});
  }
  std::sort(found.begin(), found.end(), [](const Approach& a, const Approach& b) {
    return a.fraction < b.fraction || (a.fraction == b.fraction && a.node < b.node);
  });
  return found;
}

/// The next node of a run: beyond `piece`, across a corner of a triangle at the vertex.
bool PathGraph::extend(int node, int i, VertexIndex vertex, double reach, int& next) const {
  next = other_end(i, node);
  const Place& place = at(next).place;
  return piece(i).triangle.valid() && may_move(next) && is_end_of(place.edge, vertex) &&
         fraction_from(vertex, place) <= reach;
}

/// No node but `except` lies on the edge less than `up_to` of it away from its end `from`.
bool PathGraph::is_clear(HalfEdge edge, VertexIndex from, double up_to, int except) const {
  for (int n = trace_->first_on(first_half_edge(*sheet_, edge)); n >= 0; n = trace_->node(n).next)
    if (n != except && !at(n).gone && at(n).place.kind == Place::Kind::edge && fraction_from(from, at(n).place) < up_to)
      return false;
  return true;
}

/// No node lies on the edge between these two, which do.
bool PathGraph::is_clear_between(HalfEdge edge, int a, int b) const {
  const VertexIndex from = sheet_->origin(edge);
  const auto progress = [&](int n) {
    const Place& p = at(n).place;
    return p.kind == Place::Kind::edge ? fraction_from(from, p) : p.vertex == from ? 0.0 : 1.0;
  };
  const double low = std::min(progress(a), progress(b)), high = std::max(progress(a), progress(b));
  for (int n = trace_->first_on(first_half_edge(*sheet_, edge)); n >= 0; n = trace_->node(n).next)
    if (n != a && n != b && !at(n).gone && at(n).place.kind == Place::Kind::edge && progress(n) >= low &&
        progress(n) <= high)
      return false;
  return true;
}

/// No other node lies between the vertex and this one, nor the edge's other end or another node so near behind it that
/// rounding decides which is nearer: two lines that nearly coincide may cross many times, and contracting one of them
/// would enlarge the thin pieces that they enclose.
bool PathGraph::is_nearest(int node, VertexIndex vertex) const {
  const HalfEdge edge = at(node).place.edge;
  const double length =
      std::sqrt(squared_length(sheet_->rest(sheet_->target(edge)) - sheet_->rest(sheet_->origin(edge))));
  const double behind = fraction_from(vertex, at(node).place) + coincidence() / length;
  return behind <= 1 && is_clear(edge, vertex, behind, node);
}

/// A triangle at the edge is lower than a few snap distances: a path along the edge could enclose nothing but that.
bool PathGraph::is_beside_flat_triangle(HalfEdge edge) const {
  const Point2 from = sheet_->rest(sheet_->origin(edge)), along = sheet_->rest(sheet_->target(edge)) - from;
  for (const HalfEdge h : {edge, sheet_->opposite(edge)})
    if (h.valid() && std::abs(cross(along, sheet_->rest(sheet_->origin(Sheet::previous(h))) - from)) <=
                         coincidence() * std::sqrt(squared_length(along)))
      return true;
  return false;
}

/// A node inside t, other than these, lies in a part of it.
bool PathGraph::holds_node(TriangleIndex t, const std::array<Point2, 3>& part, std::initializer_list<int> but) const {
  for (int n = trace_->face(trace_->find_face(t)).inside; n >= 0; n = trace_->node(n).next)
    if (std::find(but.begin(), but.end(), n) == but.end() && !at(n).gone &&
        in_closed_triangle(part[0], part[1], part[2], point(n)))
      return true;
  return false;
}

/// The piece from `node` of the run to `end` becomes one from the vertex to `end`: nothing of the path lies in between,
/// and no separating edge in the new way.
bool PathGraph::sweep_is_clear(int end, int i, int node, VertexIndex vertex) const {
  const TriangleIndex t = piece(i).triangle;
  const Place& place = at(end).place;
  if (!t.valid() || common_edge(*sheet_, t, place, at(node).place).valid())
    return true;  // on along the node's own edge
  if (const HalfEdge edge = common_edge(*sheet_, t, place, place_at(*sheet_, vertex)); edge.valid()) {
    const double distance = place.kind == Place::Kind::edge ? fraction_from(vertex, place) : 2;
    if (sheet_->separates(edge) || !is_clear(edge, vertex, distance) || is_beside_flat_triangle(edge)) return false;
  }
  return !holds_node(t, {point(end), point(node), sheet_->rest(vertex)}, {end, node});
}

/// The run, if none but its own nodes had to be looked at. \pre the node may go to the vertex
bool PathGraph::collect_run(int node, VertexIndex vertex, double reach, Run& run) const {
  run.vertex = vertex;
  run.nodes.assign(1, node);
  const auto follow = [&](int i, int& end, int& end_piece) {  // false: the path goes round the vertex to itself
    end = end_piece = -1;
    for (int from = node; i >= 0;) {
      int next = -1;
      if (!extend(from, i, vertex, reach, next)) {
        end = next;
        end_piece = i;
        break;
      }
      if (next == node) return false;
      run.nodes.push_back(next);
      const Node& n = at(next);
      i = n.degree == 1 ? -1 : n.piece[0] == i ? n.piece[1] : n.piece[0];
      from = next;
    }
    return true;
  };
  if (!follow(at(node).piece[0], run.before, run.piece_before)) return false;
  std::reverse(run.nodes.begin(), run.nodes.end());
  if (!follow(at(node).piece[1], run.after, run.piece_after)) return false;
  return run.before != run.after;  // they are equal also where neither is there
}

bool PathGraph::is_on_separator(VertexIndex v) const {
  bool on_separator = false;
  for (const HalfEdge h : outgoing_edges(*sheet_, v)) {
    on_separator |= sheet_->separates(h);
  }
  return on_separator;
}

bool PathGraph::find_run(int node, VertexIndex vertex, double reach, Run& run) const {
  if (!may_move(node) || trace_->node_at(vertex) >= 0 || std::binary_search(taken_.begin(), taken_.end(), vertex))
    return false;
  if (!collect_run(node, vertex, reach, run)) return false;
  std::size_t separating = 0;
  for (const int n : run.nodes) {
    separating += sheet_->separates(at(n).place.edge);
    if (!is_nearest(n, vertex)) return false;
  }
  if (separating != (is_on_separator(vertex) ? 1 : 0)) return false;
  return (run.before < 0 || sweep_is_clear(run.before, run.piece_before, run.nodes.front(), vertex)) &&
         (run.after < 0 || sweep_is_clear(run.after, run.piece_after, run.nodes.back(), vertex));
}

// --- tips ------------------------------------------------------------------------------------------------------------

bool PathGraph::is_tip(int node) const {
  const Node& n = at(node);
  if (n.gone || n.degree != 1) return false;
  if (n.place.kind == Place::Kind::vertex) return !is_on_separator(n.place.vertex);
  return n.place.kind == Place::Kind::face || !sheet_->separates(n.place.edge);
}

std::vector<PathGraph::Approach> PathGraph::tips(double reach, const Polyline& path) const {
  const auto goes_on = [&](int node) {
    if (!path.goes_on) return false;
    const Point2 p = point(node);
    return squared_length(p - path.points.back()) < squared_length(p - path.points.front());
  };
  std::vector<Approach> found;
  for (int i = 0; i < size() && reach > 0; ++i) {
    const Place& place = at(i).place;
    if (place.kind == Place::Kind::vertex || !is_tip(i) || goes_on(i)) continue;
    const std::size_t first = found.size();
    const auto add = [&](VertexIndex v, double coordinate) {
      if (1 - coordinate <= reach) found.push_back({i, v, 1 - coordinate});
    };
    if (place.kind == Place::Kind::edge) {
      add(sheet_->origin(place.edge), 1 - place.lambda);
      add(sheet_->target(place.edge), place.lambda);
    } else {
      const auto c = sheet_->corners(place.face);
      const double whole = cross(c[1] - c[0], c[2] - c[0]);
      for (std::size_t k = 0; k < 3; ++k) {
        const Point2 a = c[(k + 1) % 3] - place.point, b = c[(k + 2) % 3] - place.point;
        add(sheet_->triangle(place.face).vertex[k], cross(a, b) / whole);
      }
    }
    std::sort(found.begin() + to_index(first), found.end(), [&](const Approach& a, const Approach& b) {
      const double to_a = squared_length(sheet_->rest(a.vertex) - place.point);
      const double to_b = squared_length(sheet_->rest(b.vertex) - place.point);
      return to_a < to_b || (to_a == to_b && a.vertex < b.vertex);
    });
  }
  return found;
}

/// No other piece of the path crosses or touches the triangle that the tip lies in, and no corner of it lies there.
bool PathGraph::has_triangle_to_itself(int tip) const {
  const TriangleIndex t = at(tip).place.face;
  for (int n = trace_->face(trace_->find_face(t)).inside; n >= 0; n = trace_->node(n).next)
    if (n != tip && !at(n).gone) return false;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (!pieces_[i].gone && pieces_[i].triangle == t && to_int(i) != at(tip).piece[0]) return false;
  return true;
}

bool PathGraph::find_tip_run(int tip, VertexIndex vertex, double reach, Run& run) const {
  if (!is_tip(tip) || at(tip).place.kind == Place::Kind::vertex || trace_->node_at(vertex) >= 0 ||
      std::binary_search(taken_.begin(), taken_.end(), vertex) || is_on_separator(vertex))
    return false;
  const bool inside = at(tip).place.kind == Place::Kind::face;
  if (inside && !has_triangle_to_itself(tip)) return false;
  if (!collect_run(tip, vertex, reach, run)) return false;
  for (const int n : run.nodes)
    if (!(inside && n == tip) && !is_nearest(n, vertex)) return false;
  return !is_tip(run.before) && sweep_is_clear(run.before, run.piece_before, run.nodes.front(), vertex);
}

bool PathGraph::retract(int tip, VertexIndex vertex) {
  if (!is_tip(tip) || at(tip).place.kind == Place::Kind::vertex) return false;
  const int dropped = at(tip).piece[0], end = other_end(dropped, tip);
  Node& n = nodes_[to_size(end)];
  if (n.degree != 2 || n.place.kind != Place::Kind::vertex || n.place.vertex != vertex || is_on_separator(vertex))
    return false;
  const int kept = n.piece[0] == dropped ? n.piece[1] : n.piece[0];
  if (is_tip(other_end(kept, end))) return false;
  n.degree = 1;
  n.piece = {kept, -1};
  pieces_[to_size(dropped)].gone = true;
  nodes_[to_size(tip)].gone = true;
  return true;
}

// --- changing --------------------------------------------------------------------------------------------------------

bool PathGraph::has_star_to_itself(const Run& run) const {
  const auto is_met_by_others = [&](HalfEdge edge) {
    for (int n = trace_->first_on(first_half_edge(*sheet_, edge)); n >= 0; n = trace_->node(n).next)
      if (!at(n).gone && at(n).place.kind == Place::Kind::edge &&
          std::find(run.nodes.begin(), run.nodes.end(), n) == run.nodes.end())
        return true;
    return false;
  };
  for (const HalfEdge h : outgoing_edges(*sheet_, run.vertex)) {
    const int face = trace_->find_face(triangle_of(h));
    for (int n = face >= 0 ? trace_->face(face).inside : -1; n >= 0; n = trace_->node(n).next)
      if (!at(n).gone && std::find(run.nodes.begin(), run.nodes.end(), n) == run.nodes.end()) return false;
    if (is_met_by_others(h) || is_met_by_others(Sheet::previous(h))) return false;
  }
  return true;
}

void PathGraph::contract(const Run& run) {
  for (std::size_t i = 1; i < run.nodes.size(); ++i) {
    for (const int shared : at(run.nodes[i - 1]).piece)
      if (shared >= 0 && shared != run.piece_before && other_end(shared, run.nodes[i - 1]) == run.nodes[i])
        pieces_[to_size(shared)].gone = true;
    nodes_[to_size(run.nodes[i])].gone = true;
  }
  const int kept = run.nodes.front(), last = run.nodes.back();
  if (run.piece_after >= 0) {
    Piece& after = pieces_[to_size(run.piece_after)];
    (after.from == last ? after.from : after.to) = kept;
  }
  Node& node = nodes_[to_size(kept)];
  node.place = place_at(*sheet_, run.vertex);
  node.piece = {run.piece_before, run.piece_after};
  node.degree = (run.piece_before >= 0) + (run.piece_after >= 0);
  taken_.insert(std::lower_bound(taken_.begin(), taken_.end(), run.vertex), run.vertex);
}

bool PathGraph::straighten(int node) {
  const Node& n = at(node);
  if (n.gone || n.place.kind != Place::Kind::face || n.degree != 2) return false;
  const TriangleIndex t = n.place.face;
  const int kept = n.piece[0], dropped = n.piece[1];
  const int before = other_end(kept, node), after = other_end(dropped, node);
  if (before == after || (at(before).degree > 2 && at(after).degree > 2)) return false;
  if (at(before).degree == 1 && at(after).degree == 1) return false;  // a single edge between tips would not open
  const auto& [from, to] = at(before).degree <= 2 ? std::pair{before, after} : std::pair{after, before};
  for (const int known : at(from).piece)
    if (known >= 0 && other_end(known, from) == to) return false;  // a loop closes
  if (holds_node(t, {point(before), point(node), point(after)}, {before, node, after})) return false;
  if (const HalfEdge edge = common_edge(*sheet_, t, at(before).place, at(after).place); edge.valid())
    if (sheet_->separates(edge) || !is_clear_between(edge, before, after) || is_beside_flat_triangle(edge))
      return false;

  Piece& piece = pieces_[to_size(kept)];
  (piece.from == node ? piece.from : piece.to) = after;
  pieces_[to_size(dropped)].gone = true;
  for (int& known : nodes_[to_size(after)].piece)
    if (known == dropped) known = kept;
  nodes_[to_size(node)].gone = true;
  return true;
}

void snap_to_vertices(const Sheet& sheet, Subdivision& trace, const Polyline& asked, double tolerance,
                      PathGraph& path) {
  path.read(sheet, trace);
  const auto near = path.approaches(tolerance), tips = path.tips(tolerance, asked);
  PathGraph::Run run;
  for (const auto& tip : tips)
    if (path.find_tip_run(tip.node, tip.vertex, tolerance, run)) path.contract(run);
  for (const auto& crossing : near)
    if (path.find_run(crossing.node, crossing.vertex, tolerance, run)) path.contract(run);
  if (!near.empty() || !tips.empty()) path.write(trace);
}

}  // namespace cutbench
