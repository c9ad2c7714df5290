#include "methods/tools/delaunay_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"

namespace cutbench {

namespace {

HalfEdge shortest_edge(const Sheet& sheet, TriangleIndex t) {
  HalfEdge shortest = half_edge(t, 0);
  for (int k : {1, 2})
    if (squared_length(sheet, half_edge(t, k)) < squared_length(sheet, shortest)) shortest = half_edge(t, k);
  return shortest;
}

/// Of an edge that does not separate; exact.
bool is_delaunay(const Sheet& sheet, HalfEdge h) {
  const auto c = sheet.corners(triangle_of(h));
  return in_circle(c[0], c[1], c[2], sheet.rest(sheet.origin(Sheet::previous(sheet.opposite(h))))) <= 0;
}

/// Where the straight way from inside `from` to p ends: in a triangle, at p, or before it, at an edge that separates.
/// Neither: it got lost, in triangles too thin for doubles.
struct Arrival {
  TriangleIndex triangle;
  HalfEdge blocked;
};

/// `doubtful` receives the edges on the way that are not Delaunay.
Arrival walk(const Sheet& sheet, TriangleIndex from, Point2 p, std::vector<HalfEdge>& doubtful) {
  constexpr int most_steps = 1000;
  const auto c = sheet.corners(from);
  const Point2 start = 1.0 / 3 * (c[0] + c[1] + c[2]);
  HalfEdge entered;
  doubtful.clear();
  TriangleIndex t = from;
  for (int step = 0; step < most_steps; ++step) {
    HalfEdge exit;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (h == entered || orientation(sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h)), p) >= 0) continue;
      // Of two edges that p lies beyond, the way leaves by the one on its side of their common vertex.
      const bool is_second = exit.valid() && Sheet::next(exit) == h;
      const HalfEdge first = is_second ? exit : h, second = is_second ? h : exit;
      const bool by_first = !second.valid() || orientation(start, p, sheet.rest(sheet.target(first))) >= 0;
      exit = by_first ? first : second;
    }
    if (!exit.valid()) return {t, {}};
    if (sheet.separates(exit)) return {{}, exit};
    entered = sheet.opposite(exit);
    if (!is_delaunay(sheet, exit)) doubtful.push_back(exit);
    t = triangle_of(entered);
  }
  return {};
}

/// Does p lie strictly inside the circle over the edge?
bool encroaches(const Sheet& sheet, HalfEdge h, Point2 p) {
  return dot(sheet.rest(sheet.origin(h)) - p, sheet.rest(sheet.target(h)) - p) < 0;
}

/// Another edge that separates leaves `apex` at less than 60 degrees from the one to `end`.
bool is_leg(const Sheet& sheet, VertexIndex apex, VertexIndex end) {
  const Point2 along = sheet.rest(end) - sheet.rest(apex);
  bool found = false;
  const auto look = [&](VertexIndex v) {
    const Point2 other = sheet.rest(v) - sheet.rest(apex);
    const double cosine = dot(along, other);
    found |= v != end && cosine > 0 && 4 * cosine * cosine > squared_length(along) * squared_length(other);
  };
  for_each_separating_end(sheet, apex, look);
  return found;
}

}  // namespace

bool DelaunayRefinement::is_ill_shaped(const Sheet& sheet, TriangleIndex t) const {
  if (!sheet.triangle(t).alive()) return false;
  const auto c = sheet.corners(t);
  return aspect_ratio(c[0], c[1], c[2]) > options_.bound && !wedges_->hold(c);
}

Point2 DelaunayRefinement::off_centre(const Sheet& sheet, TriangleIndex t) const {
  const HalfEdge base = shortest_edge(sheet, t);
  const Point2 a = sheet.rest(sheet.origin(base)), b = sheet.rest(sheet.target(base));
  const Point2 middle = 0.5 * (a + b), edge = b - a, apex = sheet.rest(sheet.origin(Sheet::previous(base))) - middle;
  const double length = std::sqrt(squared_length(edge));
  const Point2 up{-edge.y / length, edge.x / length};
  const double height = dot(apex, up);  // rounded: of a needle it may come out as zero or less
  const double circumcentre = height > 0 ? (squared_length(apex) - 0.25 * length * length) / (2 * height)
                                         : std::numeric_limits<double>::infinity();
  // An isosceles triangle of base 1 and height x has the aspect ratio x + 1 / (4 x); some of the bound is left over for
  // rounding and for what comes to lie beside it.
  const double aspect = 0.95 * options_.bound;
  const double slim = (aspect + std::sqrt(aspect * aspect - 1)) / 2;
  return middle + std::min(circumcentre, slim * length) * up;
}

/// Fills encroached_ with the edges that separate and would see p, a new vertex in t, at more than a right angle.
bool DelaunayRefinement::find_encroached(const Sheet& sheet, TriangleIndex t, Point2 p) {
  cavity_.assign(1, t);
  encroached_.clear();
  met_.clear(sheet.triangle_slots());
  met_.insert(t);
  for (std::size_t i = 0; i < cavity_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(cavity_[i], k), o = sheet.opposite(h);
      if (sheet.separates(h)) {
        if (encroaches(sheet, h, p)) encroached_.push_back(h);
        continue;
      }
      const TriangleIndex next = triangle_of(o);
      if (met_.holds(next)) continue;
      const auto c = sheet.corners(next);
      if (in_circle(c[0], c[1], c[2], p) > 0) {
        cavity_.push_back(next);
        met_.insert(next);
      }
    }
  return !encroached_.empty();
}

/// The power of two next to x > 0, its logarithm rounded: without the C library's logarithm, which differs from one to
/// the next.
double nearest_power_of_two(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);  // at least 1/2
  return std::ldexp(1, fraction < std::numbers::sqrt2 / 2 ? exponent - 1 : exponent);
}

/// Divides a piece of path, incision or border; false where it is too short, or doubles too coarse.
bool DelaunayRefinement::split_segment(Sheet& sheet, HalfEdge h) {
  const double length = std::sqrt(squared_length(sheet, h));
  if (length < 2 * options_.min_edge * sheet.mean_edge()) return false;
  const bool from_origin = is_leg(sheet, sheet.origin(h), sheet.target(h));
  const bool from_target = is_leg(sheet, sheet.target(h), sheet.origin(h));
  double fraction = 0.5;
  if (from_origin != from_target) {
    const double shell = nearest_power_of_two(0.5 * length / sheet.mean_edge()) * sheet.mean_edge();
    fraction = from_origin ? shell / length : 1 - shell / length;
  }
  const Point2 a = sheet.rest(sheet.origin(h)), p = a + fraction * (sheet.rest(sheet.target(h)) - a);
  if (!halves_are_positive(sheet, h, p) || !halves_are_positive(sheet, sheet.opposite(h), p)) return false;
  flip_round(sheet, sheet.split_edge(h, fraction, p));
  return true;
}

/// Flips what it may of the doubtful edges, and those that this puts in doubt; false where all have to stay.
bool DelaunayRefinement::flip_doubtful(Sheet& sheet) {
  for (const HalfEdge h : doubtful_) delaunay_.add(triangle_of(h));
  delaunay_.run(sheet);
  const bool flipped = !delaunay_.changed.empty();
  note_changed(sheet);
  return flipped;
}

void DelaunayRefinement::flip_round(Sheet& sheet, VertexIndex v) {
  for_each_outgoing(sheet, v, [&](HalfEdge outgoing) {
    delaunay_.add(triangle_of(outgoing));
    delaunay_.changed.push_back(triangle_of(outgoing));
  });
  delaunay_.run(sheet);
  note_changed(sheet);
}

/// Makes a vertex for t, at its off-centre or on the edge that hides it; or, first, the way there Delaunay. False where
/// nothing could be done.
bool DelaunayRefinement::refine(Sheet& sheet, TriangleIndex t) {
  const Point2 p = off_centre(sheet, t);
  const Arrival arrival = walk(sheet, t, p, doubtful_);
  // Where the mesh on the way is not Delaunay, p might change other triangles and leave t as it is.
  if (!doubtful_.empty() && flip_doubtful(sheet)) return true;
  if (arrival.blocked.valid()) return split_segment(sheet, arrival.blocked);
  if (!arrival.triangle.valid()) return false;
  if (find_encroached(sheet, arrival.triangle, p)) return split_segment(sheet, encroached_.front());
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(arrival.triangle, k);
    if (orientation(sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h)), p) > 0) continue;
    const HalfEdge o = sheet.opposite(h);
    if (!halves_are_positive(sheet, h, p) || !halves_are_positive(sheet, o, p)) return false;
    flip_round(sheet, sheet.split_edge(
                          h, std::sqrt(squared_length(p - sheet.rest(sheet.origin(h))) / squared_length(sheet, h)), p));
    return true;
  }
  flip_round(sheet, sheet.split_triangle(arrival.triangle, p));
  return true;
}

void DelaunayRefinement::note(const Sheet& sheet, TriangleIndex t) {
  if (!is_ill_shaped(sheet, t)) return;
  heap_.push_back({squared_length(sheet, shortest_edge(sheet, t)), t});
  std::push_heap(heap_.begin(), heap_.end());
}

/// Queues what the last flips and splits left ill-shaped.
void DelaunayRefinement::note_changed(const Sheet& sheet) {
  for (const TriangleIndex t : delaunay_.changed) note(sheet, t);
  delaunay_.changed.clear();
}

void DelaunayRefinement::begin(const Sheet& sheet, const ForcedWedges& wedges) {
  wedges_ = &wedges;
  delaunay_.begin(sheet);
  heap_.clear();
}

void DelaunayRefinement::flip_at(TriangleIndex t) {
  delaunay_.add(t);
  delaunay_.changed.push_back(t);
}

bool DelaunayRefinement::run(Sheet& sheet) {
  delaunay_.run(sheet);
  note_changed(sheet);
  const EditLog& log = sheet.log();
  const std::size_t most =
      log.new_vertices.size() + std::min(options_.per_path_vertex * log.path_vertices.size(), options_.most_vertices);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const TriangleIndex t = heap_.back().triangle;
    heap_.pop_back();
    if (!is_ill_shaped(sheet, t)) continue;
    if (log.new_vertices.size() >= most) return false;
    if (refine(sheet, t)) note(sheet, t);  // its surroundings, perhaps, were changed only
  }
  return true;
}

}  // namespace cutbench
