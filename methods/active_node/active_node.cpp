#include "methods/active_node/active_node.h"

#include <algorithm>
#include <cmath>

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
  way_.clear(), turned_.clear();
  curve_.read(sheet, trace, path);
}

void ActiveNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  curve_.find_vertices(sheet, trace);
  for (const auto& node : trace.nodes) way_.push_back(node.vertex);
}

/// False where the harness has embedded the path in its own way instead.
bool ActiveNode::is_as_traced(const Sheet& sheet) const {
  for (std::size_t i = 0; i < way_.size(); ++i)
    if (way_[i]() >= sheet.vertex_slots() || !sheet.triangle_of_vertex(way_[i]).valid() ||
        sheet.rest(way_[i]) != curve_.at(static_cast<double>(i)))
      return false;
  return true;
}

void ActiveNode::measure_way(const Sheet& sheet) {
  length_.assign(way_.size(), 0), stop_.assign(way_.size(), way_.size() - 1);
  for (std::size_t i = 1; i < way_.size(); ++i)
    length_[i] = length_[i - 1] + std::sqrt(squared_length(sheet.rest(way_[i]) - sheet.rest(way_[i - 1])));
  Reshape::Neighbours neighbours;
  for (std::size_t i = way_.size() - 1; i-- > 0;) {
    const bool goes_on = i > 0 && reshape_.freedom(way_[i], neighbours) == Reshape::Freedom::along &&
                         (neighbours.before == way_[i + 1] || neighbours.after == way_[i + 1]);
    stop_[i] = goes_on ? stop_[i + 1] : i;
  }
}

/// How far along the way the next vertex of the path is to be, the last one being at `from` before crossing i: equal
/// pieces up to the next vertex that must stay.
double ActiveNode::next_target(std::size_t i, double from) const {
  const double rest = length_[stop_[i]] - from;
  return from + rest / std::max(1.0, std::round(rest / spacing_));
}

/// Flips edges at v that keep it from `to` without turning a triangle over, where that can be done; `onto` is the vertex
/// at `to` that v is to be merged with, or invalid.
void ActiveNode::make_room(Sheet& sheet, VertexIndex v, Point2 to, VertexIndex onto) {
  for (bool flipped = true; flipped;) {
    flipped = false;
    ring_.clear();
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      const VertexIndex c = sheet.target(h), d = sheet.origin(Sheet::previous(h));
      if (c != onto && d != onto && orientation(to, sheet.rest(c), sheet.rest(d)) <= 0)
        ring_.push_back(c), ring_.push_back(d);
    });
    if (ring_.size() > 128)
      return;  // a vertex of thousands of edges: looking at all of them again and again takes too long
    for (const VertexIndex c : ring_) {
      const HalfEdge spoke = edge_between(sheet, v, c);
      if (!spoke.valid() || c == onto || sheet.on_border(spoke)) continue;
      const TriangleIndex left = triangle_of(spoke), right = triangle_of(sheet.opposite(spoke));
      if (!sheet.flip(spoke)) continue;
      turned_.push_back(left), turned_.push_back(right);
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
  const double s = static_cast<double>(i) + (to - length_[i]) / (length_[i + 1] - length_[i]);
  const double from = curve_.parameter(last);
  const Point2 p = curve_.at(s);
  if (sheet.is_held(node) || !reshape_.is_near_curve(from, s, sheet.rest(last), p) ||
      !reshape_.is_near_curve(s, curve_.parameter(next), p, sheet.rest(next)))
    return false;
  make_room(sheet, node, p, {});
  if (!sheet.move(node, p)) return false;
  curve_.set_parameter(node, s);
  return true;
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
  measure_way(sheet);

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
    if (i + 1 < way_.size()) target = next_target(i + 1, at);
  }
}

}  // namespace cutbench
