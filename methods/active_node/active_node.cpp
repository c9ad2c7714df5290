#include "methods/active_node/active_node.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

/// The half-edge from one vertex to another inside the sheet; invalid where there is none.
HalfEdge edge_between(const Sheet& sheet, VertexIndex from, VertexIndex to) {
  HalfEdge found;
  for_each_outgoing(sheet, from, [&](HalfEdge h) {
    if (sheet.target(h) == to) found = h;
  });
  return found;
}

}  // namespace

void ActiveNode::adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) {
  way_.clear();
  turned_.clear();
  curve_.read(sheet, trace, path);
  node_length_.assign(1, 0);
  for (std::size_t i = 1; i < trace.nodes.size(); ++i) {
    const Point2 piece = trace.nodes[i].place.point - trace.nodes[i - 1].place.point;
    node_length_.push_back(node_length_.back() + std::sqrt(squared_length(piece)));
  }
  warp_.run(sheet, trace, curve_);
}

void ActiveNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  curve_.find_vertices(sheet, trace);
  for (const auto& node : trace.nodes) way_.push_back(node.vertex);
}

/// False where the harness has embedded the path in its own way instead.
bool ActiveNode::is_as_traced(const Sheet& sheet) const {
  return std::all_of(way_.begin(), way_.end(), [&](VertexIndex v) {
    if (v() >= sheet.vertex_slots() || !sheet.triangle_of_vertex(v).valid()) return false;
    const double s = curve_.parameter(v);
    return s < 0 || sheet.rest(v) == curve_.at(s);
  });
}

void ActiveNode::measure_way() {
  length_.assign(way_.size(), 0);
  stop_.assign(way_.size(), way_.size() - 1);
  for (std::size_t i = 1; i < way_.size(); ++i) {
    const double s = curve_.parameter(way_[i]);
    length_[i] = s >= 0 ? node_length_[to_size(s)] : length_[i - 1];
  }
  Reshape::Neighbours neighbours;
  for (std::size_t i = way_.size() - 1; i-- > 0;) {
    const bool goes_on = i > 0 && spacing_ > 0 &&
                         curve_.is_piece(curve_.parameter(way_[i]), curve_.parameter(way_[i + 1])) &&
                         reshape_.freedom(way_[i], neighbours) == Reshape::Freedom::along &&
                         (neighbours.before == way_[i + 1] || neighbours.after == way_[i + 1]);
    stop_[i] = goes_on ? stop_[i + 1] : i;
  }
}

/// The curve's parameter at a length of the way.
double ActiveNode::parameter_at(double length) const {
  const auto behind = std::upper_bound(node_length_.begin() + 1, node_length_.end() - 1, length);
  const double from = *(behind - 1);
  return to_double(behind - 1 - node_length_.begin()) + (length - from) / (*behind - from);
}

/// How far along the way the next vertex of the path is to be, the last one being at `from` before crossing i: equal
/// pieces up to the next vertex that must stay.
double ActiveNode::next_target(std::size_t i, double from) const {
  const double rest = length_[stop_[i]] - from;
  return from + rest / std::max(1.0, std::round(rest / spacing_));
}

/// Flips edges at v that keep it from `to` without turning a triangle over, where that can be done; `onto` is the
/// vertex at `to` that v is to be merged with, or invalid.
void ActiveNode::make_room(Sheet& sheet, VertexIndex v, Point2 to, VertexIndex onto) {
  for (bool flipped = true; flipped;) {
    flipped = false;
    ring_.clear();
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      const VertexIndex c = sheet.target(h), d = sheet.origin(Sheet::previous(h));
      if (c != onto && d != onto && orientation(to, sheet.rest(c), sheet.rest(d)) <= 0) {
        ring_.push_back(c);
        ring_.push_back(d);
      }
    });
    if (ring_.size() > 128)
      return;  // a vertex of thousands of edges: looking at all of them again and again takes too long
    for (const VertexIndex c : ring_) {
      const HalfEdge spoke = edge_between(sheet, v, c);
      if (!spoke.valid() || c == onto || sheet.on_border(spoke)) continue;
      const TriangleIndex left = triangle_of(spoke), right = triangle_of(sheet.opposite(spoke));
      if (!sheet.flip(spoke)) continue;
      turned_.push_back(left);
      turned_.push_back(right);
      flipped = true;
      break;
    }
  }
}

/// Merges the node with the next crossing, `to`.
bool ActiveNode::advance(Sheet& sheet, VertexIndex node, VertexIndex to) {
  if (!reshape_.may_leave_out(node, edge_between(sheet, node, to))) return false;
  make_room(sheet, node, sheet.rest(to), to);
  return sheet.collapse(edge_between(sheet, node, to));
}

/// Moves the node from crossing i on to the length `to` of the way, before the next crossing.
bool ActiveNode::slide(Sheet& sheet, std::size_t i, VertexIndex last, double to) {
  const VertexIndex node = way_[i], next = way_[i + 1];
  const double s = parameter_at(to);
  const Point2 p = curve_.at(s);
  if (sheet.is_held(node) || !reshape_.is_near_curve(curve_.parameter(last), s, sheet.rest(last), p) ||
      !reshape_.is_near_curve(s, curve_.parameter(next), p, sheet.rest(next)))
    return false;
  make_room(sheet, node, p, {});
  if (!sheet.move(node, p)) return false;
  curve_.set_parameter(node, s);
  return true;
}

/// A new vertex of the path between `last` and `next`, at the length `to` of the way; invalid where there can be none.
VertexIndex ActiveNode::leave_between(Sheet& sheet, VertexIndex last, VertexIndex next, double to) {
  const HalfEdge h = edge_between(sheet, last, next);
  const double here = curve_.parameter(last), there = curve_.parameter(next), s = parameter_at(to);
  if (!h.valid() || sheet.mark(h) != EdgeMark::path || !curve_.is_piece(here, there) || s <= here || s >= there)
    return {};
  const Point2 p = curve_.at(s);
  if (!reshape_.is_near_curve(here, s, sheet.rest(last), p) || !reshape_.is_near_curve(s, there, p, sheet.rest(next)))
    return {};
  const VertexIndex v = reshape_.split_at(h, p);
  if (v.valid()) curve_.add(v, s);
  return v;
}

/// Vertices of the sheet in the node's way are merged with it.
void ActiveNode::take_in_near(Sheet& sheet, VertexIndex node) {
  near_vertices_.clear();
  Reshape::Neighbours neighbours;
  for_each_outgoing(sheet, node, [&](HalfEdge h) {
    if (squared_length(sheet, h) < near_ * near_) near_vertices_.push_back(sheet.target(h));
  });
  for (const VertexIndex v : near_vertices_) {
    if (reshape_.freedom(v, neighbours) != Reshape::Freedom::free) continue;
    if (const HalfEdge h = edge_between(sheet, v, node); !h.valid() || !reshape_.may_leave_out(v, h)) continue;
    make_room(sheet, v, sheet.rest(node), node);
    sheet.collapse(edge_between(sheet, v, node));
  }
}

void ActiveNode::settle(Sheet& sheet, VertexIndex node) {
  take_in_near(sheet, node);
  for_each_outgoing(sheet, node, [&](HalfEdge h) { delaunay_.add(triangle_of(h)); });
  for (const TriangleIndex t : turned_)
    if (sheet.triangle(t).alive()) delaunay_.add(t);
  turned_.clear();
  delaunay_.run(sheet);
}

void ActiveNode::improve(Sheet& sheet, MethodNotes&) {
  if (way_.empty() || !is_as_traced(sheet)) return;
  spacing_ = options_.spacing * sheet.mean_edge();
  near_ = options_.near * std::min(1.0, options_.spacing) * sheet.mean_edge();
  reshape_.begin(sheet, curve_);
  delaunay_.begin(sheet);
  measure_way();

  constexpr double close = 0.05;  // of the spacing: so far from its target the next vertex of the path may be
  VertexIndex last;
  double target = 0;
  for (std::size_t i = 0; i < way_.size(); ++i) {
    const VertexIndex node = way_[i];
    settle(sheet, node);
    const bool must_stay = stop_[i] == i;
    double at = length_[i];
    if (!must_stay) {
      if (length_[i + 1] <= target + close * spacing_ && advance(sheet, node, way_[i + 1])) continue;
      if (target > at + close * spacing_ && target < length_[i + 1] && slide(sheet, i, last, target)) at = target;
      settle(sheet, node);
    }
    last = node;
    if (i + 1 == way_.size()) break;
    target = next_target(i + 1, at);
    while (spacing_ > 0 && target < length_[i + 1] - close * spacing_) {  // no crossing is met before it
      const VertexIndex v = leave_between(sheet, last, way_[i + 1], target);
      if (!v.valid()) break;
      settle(sheet, v);
      last = v;
      at = target;
      target = next_target(i + 1, at);
    }
  }
}

}  // namespace cutbench
