#include "methods/adaptive_remesh/adaptive_remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

constexpr double refused = std::numeric_limits<double>::infinity();

/// What meets at a vertex.
struct Meeting {
  int path = 0, incision = 0, edges = 0;
  bool inside = true;  // not on the border

  Meeting(const Sheet& sheet, VertexIndex v) {
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      path += sheet.mark(h) == EdgeMark::path;
      incision += sheet.mark(h) == EdgeMark::incision;
      inside &= !sheet.on_border(h);
      ++edges;
    });
  }
  bool is_tip() const { return inside && path + incision == 1; }
  bool was_tip() const { return inside && path > 0 && incision == 1; }
};

/// On the path from which h goes on: the vertex before the origin of h.
VertexIndex path_before(const Sheet& sheet, HalfEdge h) {
  VertexIndex before;
  for_each_outgoing(sheet, sheet.origin(h), [&](HalfEdge o) {
    if (o != h && sheet.mark(o) == EdgeMark::path) before = sheet.target(o);
  });
  return before;
}

/// a p b is the segment a b, to rounding.
bool is_on_segment(const Sheet& sheet, Point2 p, Point2 a, Point2 b) {
  return dot(p - a, b - p) > 0 &&
         std::abs(cross(b - a, p - a)) <= straight_border_tolerance * sheet.snap() * std::sqrt(squared_length(b - a));
}

}  // namespace

void AdaptiveRemesh::adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) {
  curve_.read(sheet, trace, path);
  if (options_.tolerance > 0) warp_.run(sheet, trace, curve_);
}

void AdaptiveRemesh::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  curve_.find_vertices(sheet, trace);
}

/// The origin of h may be collapsed along it, as far as borders and incisions are concerned.
bool AdaptiveRemesh::may_go(const Sheet& sheet, HalfEdge h) const {
  constexpr int widest = 64;  // a vertex with thousands of edges would be looked at once for each
  const VertexIndex v = sheet.origin(h);
  if (sheet.is_held(v)) return false;
  const Meeting at(sheet, v);
  if (!at.inside || at.incision > 0 || at.edges > widest) return false;
  if (at.path == 0) return true;
  if (at.path != 2 || sheet.mark(h) != EdgeMark::path) return false;
  const VertexIndex before = path_before(sheet, h), after = sheet.target(h);
  // A single edge between two tips would not open.
  if (Meeting(sheet, before).is_tip() && Meeting(sheet, after).is_tip()) return false;
  const Point2 a = sheet.rest(before), b = sheet.rest(after);
  return is_on_segment(sheet, sheet.rest(v), a, b) ||
         (tolerance_ > 0 && curve_.may_leave_out(before, v, after, a, b, tolerance_));
}

// --- the zone --------------------------------------------------------------------------------------------------------

void AdaptiveRemesh::add(TriangleIndex t) {
  if (in_zone_.insert(t)) zone_.push_back(t);
}

void AdaptiveRemesh::add_star(const Sheet& sheet, VertexIndex v) {
  for_each_outgoing(sheet, v, [&](HalfEdge h) { add(triangle_of(h)); });
}

/// Adds to reached_ the vertices within `radius` of those in it, along edges.
void AdaptiveRemesh::flood(const Sheet& sheet, double radius) {
  distance_.clear(sheet.vertex_slots());
  for (const VertexIndex v : reached_) distance_.insert(v, 0);
  for (std::size_t i = 0; i < reached_.size(); ++i) {
    const VertexIndex v = reached_[i];
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      const double d = distance_.at(v) + std::sqrt(squared_length(sheet, h));
      if (d <= radius && distance_.insert(sheet.target(h), d)) reached_.push_back(sheet.target(h));
    });
  }
}

void AdaptiveRemesh::find_zone(const Sheet& sheet) {
  constexpr double detour = 1.5;  // of a way along edges
  const double h = sheet.mean_edge();
  field_.begin(h, (flips_alone() ? 1 : options_.tip) * h, options_.growth, sheet.vertex_slots());
  zone_.clear();
  in_zone_.clear(sheet.triangle_slots());
  for_each_changed(sheet, [&](TriangleIndex t) { add(t); });

  // Tips that the field has to know: all that reach into the zone.
  reached_ = sheet.log().path_vertices;
  flood(sheet, detour * (field_.reach() + h));
  for (const VertexIndex v : reached_)
    if (Meeting(sheet, v).is_tip()) field_.add_tip(sheet.rest(v));

  reached_.clear();
  for (const VertexIndex v : sheet.log().path_vertices)
    if (const Meeting at(sheet, v); at.is_tip() || at.was_tip()) reached_.push_back(v);
  flood(sheet, detour * field_.reach());
  for (const VertexIndex v : reached_) add_star(sheet, v);
  if (!flips_alone()) find_metrics(sheet);
}

/// What the deformed sheet asks for at the vertices of the zone.
void AdaptiveRemesh::find_metrics(const Sheet& sheet) {
  constexpr double rounding = 1 + 1e-6;  // of slivers at rest
  const double mean_edge = sheet.mean_edge(), h_tip = options_.tip * mean_edge;
  metric_of_.clear(sheet.triangle_slots());
  const auto metric_of = [&](TriangleIndex t) {
    if (metric_of_.insert(t))
      metric_of_.at(t) = field_.bounded(deformed_metric(sheet, state_, t, options_.deformed, mean_edge, h_tip));
    return metric_of_.at(t);
  };
  measured_.clear(sheet.vertex_slots());
  for (const TriangleIndex zone : zone_)
    for (const VertexIndex v : sheet.triangle(zone).vertex) {
      if (!measured_.insert(v)) continue;
      double sum = 0, area = 0;
      for_each_outgoing(sheet, v, [&](HalfEdge h) {
        const auto corners = sheet.corners(triangle_of(h));
        const double twice = cross(corners[1] - corners[0], corners[2] - corners[0]);
        sum += twice * metric_of(triangle_of(h));
        area += twice;
      });
      if (sum > rounding * area * field_.bounded(0)) field_.set_metric(v, field_.bounded(sum / area));
    }
}

// --- split -----------------------------------------------------------------------------------------------------------

bool AdaptiveRemesh::split(Sheet& sheet, HalfEdge h) {
  const HalfEdge o = sheet.opposite(h);
  const std::array ends{sheet.origin(h), sheet.target(h)};
  const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
  const VertexIndex apex = sheet.origin(Sheet::previous(h));
  const bool left = in_zone_.holds(triangle_of(h)), right = o.valid() && in_zone_.holds(triangle_of(o));
  // Where the curve's own point is behind a vertex, the middle of the edge does: an edge that stayed for ever would
  // draw the vertices beside it nearer in every round, since it is the longest of its triangles.
  const auto split_at_curve = [&]() -> VertexIndex {
    if (tolerance_ == 0 || sheet.mark(h) != EdgeMark::path) return {};
    const double from = curve_.parameter(ends[0]), to = curve_.parameter(ends[1]);
    if (!curve_.may_divide(from, to, a, b, tolerance_)) return {};
    const VertexIndex v = split_beside(sheet, h, curve_.at((from + to) / 2));
    if (v.valid()) curve_.add(v, (from + to) / 2);
    return v;
  };
  const auto halve = [&]() -> VertexIndex {
    const Point2 middle = 0.5 * a + 0.5 * b;
    if (!halves_are_positive(sheet, h, middle) || !halves_are_positive(sheet, o, middle)) return {};
    return sheet.split_edge(h, 0.5, middle);
  };
  VertexIndex v = split_at_curve();
  if (!v.valid()) v = halve();
  if (!v.valid()) return false;
  field_.set_between(v, ends[0], ends[1]);
  in_zone_.grow(sheet.triangle_slots());
  for_each_outgoing(sheet, v, [&](HalfEdge out) {
    const bool is_left = sheet.target(out) == apex || sheet.origin(Sheet::previous(out)) == apex;
    if (is_left ? left : right) add(triangle_of(out));
    doubtful_.push_back(triangle_of(out));
  });
  return true;
}

bool AdaptiveRemesh::split_long(Sheet& sheet, std::size_t most_vertices) {
  bool any = false;
  for (std::size_t i = 0; i < zone_.size(); ++i) {
    const TriangleIndex t = zone_[i];
    while (sheet.triangle(t).alive() && sheet.log().new_vertices.size() < most_vertices) {
      HalfEdge worst;
      double most = longest;
      const auto v = sheet.triangle(t).vertex;
      for (int k = 0; k < 3; ++k)
        if (const double length = field_.relative_length(sheet, v[to_size(k)], v[to_size(next_corner(k))]);
            length > most) {
          worst = half_edge(t, k);
          most = length;
        }
      if (!worst.valid() || !split(sheet, worst)) break;
      any = true;
    }
  }
  return any;
}

// --- flip ------------------------------------------------------------------------------------------------------------

/// Lawson's flips from the doubtful triangles on, of edges with the zone on one side at least.
void AdaptiveRemesh::flip(Sheet& sheet) {
  constexpr double sharpest = 40 * std::numbers::pi / 180;  // of the deformed sheet, as in ARCSim
  state_.follow(sheet);
  open_.clear();
  const auto open = [&](TriangleIndex t) {
    for (int k = 0; k < 3; ++k) open_.push_back(half_edge(t, k));
  };
  for (const TriangleIndex t : doubtful_)
    if (sheet.triangle(t).alive()) open(t);
  doubtful_.clear();
  while (!open_.empty()) {
    const HalfEdge h = open_.back();
    open_.pop_back();
    if (sheet.separates(h)) continue;
    const TriangleIndex t = triangle_of(h), u = triangle_of(sheet.opposite(h));
    if (!in_zone_.holds(t) && !in_zone_.holds(u)) continue;
    if (std::abs(bend_angle(sheet, state_, h)) >= sharpest) continue;
    const auto c = sheet.corners(t);
    if (in_circle(c[0], c[1], c[2], sheet.rest(sheet.origin(Sheet::previous(sheet.opposite(h))))) <= 0) continue;
    if (sheet.flip(h)) {
      open(t);
      open(u);
    }
  }
}

// --- collapse --------------------------------------------------------------------------------------------------------

/// The largest aspect ratio after the origin of h went to its target; `refused` where that may not be. What is there
/// already, round either end, may be there afterwards; a very short edge may even leave it twice as bad, since in a
/// cluster of vertices the edges would keep one another (ten times as bad changes nothing more).
double AdaptiveRemesh::worst_after_collapse(const Sheet& sheet, HalfEdge h) const {
  constexpr double max_aspect = 6, very_short = 0.25, worse = 2;
  if (!may_go(sheet, h)) return refused;
  const VertexIndex a = sheet.origin(h), b = sheet.target(h);
  const Point2 to = sheet.rest(b);
  double aspect_before = max_aspect, length_before = longest;
  for (const HalfEdge end : {h, sheet.opposite(h)})
    for_each_outgoing(sheet, sheet.origin(end), [&](HalfEdge out) {
      const auto c = sheet.corners(triangle_of(out));
      aspect_before = std::max(aspect_before, oriented_aspect(c[0], c[1], c[2]));
    });
  double aspect = 0, length = 0;
  for_each_outgoing(sheet, sheet.origin(h), [&](HalfEdge out) {
    const VertexIndex c = sheet.target(out), d = sheet.origin(Sheet::previous(out));
    const Point2 p = sheet.rest(c), q = sheet.rest(d);
    if (c != b && d != b) aspect = std::max(aspect, oriented_aspect(to, p, q));
    if (c == b) return;
    length_before = std::max(length_before, field_.relative_length(sheet, a, c));
    length = std::max(length, field_.relative_length(sheet, b, c));
  });
  if (field_.relative_length(sheet, a, b) < very_short) aspect_before *= worse;
  return aspect <= aspect_before && length <= length_before ? aspect : refused;
}

bool AdaptiveRemesh::collapse_short(Sheet& sheet) {
  bool any = false;
  for (const TriangleIndex t : zone_) {
    if (!sheet.triangle(t).alive()) continue;
    HalfEdge best;
    double least = refused;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge edge = half_edge(t, k);
      if (sheet.on_border(edge) || sheet.mark(edge) == EdgeMark::incision) continue;
      if (field_.relative_length(sheet, sheet.origin(edge), sheet.target(edge)) >= shortest) continue;
      for (const HalfEdge h : {edge, sheet.opposite(edge)})
        if (const double worst = worst_after_collapse(sheet, h); worst < least) {
          best = h;
          least = worst;
        }
    }
    if (!best.valid()) continue;
    const VertexIndex kept = sheet.target(best);
    if (!sheet.collapse(best)) continue;
    any = true;
    for_each_outgoing(sheet, kept, [&](HalfEdge out) { doubtful_.push_back(triangle_of(out)); });
  }
  return any;
}

void AdaptiveRemesh::improve(Sheet& sheet, MethodNotes& notes) {
  constexpr int most_rounds = 10;
  constexpr std::size_t per_path_vertex = 20, at_least = 1000;
  tolerance_ = std::min(options_.tolerance * sheet.mean_edge(), curve_.chord_tolerance());
  state_.begin(sheet);
  find_zone(sheet);
  const EditLog& log = sheet.log();
  const std::size_t most_vertices = log.new_vertices.size() + per_path_vertex * log.path_vertices.size() + at_least;
  doubtful_ = zone_;
  notes.stopped_early = true;
  for (int round = 0; round < most_rounds && notes.stopped_early; ++round) {
    bool changed = !flips_alone() && split_long(sheet, most_vertices);
    flip(sheet);
    changed |= !flips_alone() && collapse_short(sheet);
    flip(sheet);
    notes.stopped_early = changed;
  }
  notes.stopped_early |= log.new_vertices.size() >= most_vertices;
}

}  // namespace cutbench
