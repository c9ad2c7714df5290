#include "methods/tools/reshape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"

namespace cutbench {

namespace {

/// The edges opposite to a vertex in its triangles, which decide where it may move.
class VertexLink {
 public:
  VertexLink(const Sheet& sheet, VertexIndex v) {
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      if (size_ < edges_.size())
        edges_[size_] = {sheet.rest(sheet.target(h)), sheet.rest(sheet.origin(Sheet::previous(h)))};
      ++size_;
    });
  }
  bool is_whole() const { return size_ <= edges_.size(); }
  /// The largest aspect ratio with the vertex at p; any value of at least `enough` where it is not below that.
  double worst(Point2 p, double enough) const {
    double worst = 0;
    for (std::size_t i = 0; i < size_ && worst < enough; ++i)
      worst = std::max(worst, oriented_aspect(p, edges_[i][0], edges_[i][1]));
    return worst;
  }

 private:
  std::array<std::array<Point2, 2>, 16> edges_;
  std::size_t size_ = 0;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double good = 0.9;  // times the largest aspect ratio allowed: the search stops below it

/// The vertex has over 64 edges. It may have thousands, and what looks at all of them for each of its triangles takes
/// time that grows with the square of their number: it stays where it is, and so do its neighbours as such.
bool is_wide(const Sheet& sheet, VertexIndex v) {
  constexpr int widest = 64;
  const TriangleIndex t = sheet.triangle_of_vertex(v);
  int k = 0;
  while (sheet.origin(half_edge(t, k)) != v) ++k;
  const HalfEdge first = half_edge(t, k);
  int edges = 1;
  HalfEdge h = first;
  do h = sheet.next_outgoing(h);
  while (h.valid() && h != first && ++edges <= widest);
  if (h.valid()) return edges > widest;
  for (h = first; h.valid() && edges <= widest; h = sheet.previous_outgoing(h)) ++edges;  // the border is met
  return edges > widest;
}

}  // namespace

void Reshape::begin(Sheet& sheet, PathCurve& curve) {
  sheet_ = &sheet;
  curve_ = &curve;
  h_ = sheet.mean_edge();
  tolerance_ = std::min(options_.tolerance * h_, curve.chord_tolerance());
}

bool Reshape::is_ill_shaped(TriangleIndex t) const {
  if (!sheet_->triangle(t).alive()) return false;
  const auto c = sheet_->corners(t);
  return aspect_ratio(c[0], c[1], c[2]) >= options_.max_aspect && !wedges_.hold(c);
}

std::vector<TriangleIndex> Reshape::changed_triangles() const {
  std::vector<TriangleIndex> changed;
  for_each_changed(*sheet_, [&](TriangleIndex t) { changed.push_back(t); });
  return changed;
}

/// A vertex of the path may move along the curve if it has two pieces of path and neither border nor older incision; a
/// vertex with none of these may move freely.
Reshape::Freedom Reshape::freedom(VertexIndex v, Neighbours& neighbours) const {
  if (sheet_->is_held(v)) return Freedom::none;
  int pieces = 0;
  const HalfEdge first = sheet_->first_outgoing(v);
  HalfEdge h = first;
  do {
    const EdgeMark mark = sheet_->mark(h);
    if (sheet_->on_border(h) || mark == EdgeMark::incision) return Freedom::none;
    if (mark == EdgeMark::path) {
      if (pieces == 2) return Freedom::none;
      (pieces == 0 ? neighbours.before : neighbours.after) = sheet_->target(h);
      ++pieces;
    }
    h = sheet_->next_outgoing(h);
    if (!h.valid()) return Freedom::none;
  } while (h != first);
  return pieces == 0 ? Freedom::free : pieces == 2 ? Freedom::along : Freedom::none;
}

/// Inside the sheet, with one piece of path or incision.
bool Reshape::is_tip(VertexIndex v) const {
  int pieces = 0;
  bool inside = true;
  for_each_outgoing(*sheet_, v, [&](HalfEdge h) {
    pieces += sheet_->mark(h) != EdgeMark::none;
    inside &= !sheet_->on_border(h);
  });
  return inside && pieces == 1;
}

// --- thinning --------------------------------------------------------------------------------------------------------

/// The largest aspect ratio of the triangles that replace those round the origin of h; infinite where one would not be
/// positive.
double Reshape::worst_after_collapse(HalfEdge h) const {
  const VertexIndex b = sheet_->target(h);
  const Point2 to = sheet_->rest(b);
  double worst = 0;
  for_each_outgoing(*sheet_, sheet_->origin(h), [&](HalfEdge outgoing) {
    const VertexIndex c = sheet_->target(outgoing), d = sheet_->origin(Sheet::previous(outgoing));
    if (c != b && d != b) worst = std::max(worst, oriented_aspect(to, sheet_->rest(c), sheet_->rest(d)));
  });
  return worst;
}

bool Reshape::may_leave_out(VertexIndex v, HalfEdge towards) const {
  Neighbours n;
  if (is_wide(*sheet_, v)) return false;
  const Freedom how = freedom(v, n);
  if (how != Freedom::along) return how == Freedom::free;
  if (sheet_->mark(towards) != EdgeMark::path) return false;
  if (is_tip(n.before) && is_tip(n.after)) return false;  // a single edge between tips would not open
  return curve_->may_leave_out(n.before, v, n.after, sheet_->rest(n.before), sheet_->rest(n.after), tolerance_);
}

/// Collapses the shortest edge at path vertex v if it is too short; false where there is none, or it may not be.
bool Reshape::shorten_at(VertexIndex v) {
  const double most = options_.short_edge * options_.short_edge * h_ * h_;
  HalfEdge shortest;
  double length2 = most;
  for_each_outgoing(*sheet_, v, [&](HalfEdge h) {
    if (sheet_->on_border(h) || sheet_->mark(h) == EdgeMark::incision) return;
    const double l2 = squared_length(sheet_->rest(sheet_->target(h)) - sheet_->rest(v));
    if (l2 < length2) {
      shortest = h;
      length2 = l2;
    }
  });
  if (!shortest.valid()) return false;
  HalfEdge best;
  double least = options_.max_aspect;
  for (const HalfEdge h : {shortest, sheet_->opposite(shortest)}) {
    const VertexIndex gone = sheet_->origin(h);
    if (!may_leave_out(gone, h)) continue;
    const double worst = worst_after_collapse(h);
    if (worst < least) {
      best = h;
      least = worst;
    }
  }
  return best.valid() && sheet_->collapse(best);
}

void Reshape::thin() {
  const std::vector<VertexIndex>& vertices = sheet_->log().path_vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {  // collapsing adds none
    const VertexIndex v = vertices[i];
    while (sheet_->triangle_of_vertex(v).valid() && shorten_at(v)) {
    }
  }
}

// --- flips and moves -------------------------------------------------------------------------------------------------

bool Reshape::flip_one(TriangleIndex t) {
  HalfEdge best;
  double gain = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k), o = sheet_->opposite(h);
    if (!o.valid() || sheet_->mark(h) != EdgeMark::none) continue;
    const Point2 a = sheet_->rest(sheet_->origin(h)), b = sheet_->rest(sheet_->target(h));
    const Point2 c = sheet_->rest(sheet_->origin(Sheet::previous(h))),
                 d = sheet_->rest(sheet_->origin(Sheet::previous(o)));
    const double before = std::max(aspect_ratio(a, b, c), aspect_ratio(b, a, d));
    const double after = std::max(oriented_aspect(a, d, c), oriented_aspect(d, b, c));
    if (before - after > gain) {
      best = h;
      gain = before - after;
    }
  }
  if (!best.valid()) return false;
  const TriangleIndex other = triangle_of(sheet_->opposite(best));
  if (!sheet_->flip(best)) return false;
  queue_.push_back(t);
  queue_.push_back(other);
  return true;
}

void Reshape::note_star(VertexIndex v) {
  for_each_outgoing(*sheet_, v, [&](HalfEdge h) { queue_.push_back(triangle_of(h)); });
}

/// Pattern search for the place of v where the worst triangle at it is best.
bool Reshape::smooth(VertexIndex v) {
  Neighbours neighbours;
  if (is_wide(*sheet_, v)) return false;
  const Freedom how = freedom(v, neighbours);
  if (how == Freedom::none) return false;
  if (how == Freedom::along) return slide(v, neighbours);
  const Point2 start = sheet_->rest(v);
  const VertexLink link(*sheet_, v);
  if (!link.is_whole()) return false;
  const double worst = link.worst(start, infinity);
  Point2 best = start;
  double least = worst;
  constexpr std::array<Point2, 8> directions{
      {{1, 0}, {0.7, 0.7}, {0, 1}, {-0.7, 0.7}, {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}}};
  for (double step = 0.2 * h_; step > 0.02 * h_ && least > good * options_.max_aspect; step /= 2) {
    const Point2 centre = best;
    for (const Point2 d : directions) {
      const Point2 p = centre + step * d;
      if (const double w = link.worst(p, least); w < least) {
        best = p;
        least = w;
      }
    }
  }
  if (!(least < 0.99 * worst) || !sheet_->move(v, best)) return false;
  note_star(v);
  return true;
}

bool Reshape::slide(VertexIndex v, const Neighbours& neighbours) {
  const double from = curve_->parameter(neighbours.before), to = curve_->parameter(neighbours.after);
  const double start = curve_->parameter(v);
  if (start < 0 || from < 0 || to < 0 || (start - from) * (to - start) <= 0) return false;
  const Point2 before = sheet_->rest(neighbours.before), after = sheet_->rest(neighbours.after);
  const VertexLink link(*sheet_, v);
  if (!link.is_whole()) return false;
  const double worst = link.worst(sheet_->rest(v), infinity);
  double best = start, least = worst;
  for (double step = 0.25 * std::min(std::abs(start - from), std::abs(to - start)), i = 0; i < 3; ++i, step /= 2) {
    const double centre = best;
    for (const double s : {centre - step, centre + step}) {
      const Point2 p = curve_->at(s);
      if (const double w = link.worst(p, least); w < least && curve_->stays_near(from, s, before, p, tolerance_) &&
                                                 curve_->stays_near(s, to, p, after, tolerance_)) {
        best = s;
        least = w;
      }
    }
  }
  if (!(least < 0.99 * worst) || !sheet_->move(v, curve_->at(best))) return false;
  curve_->set_parameter(v, best);
  note_star(v);
  return true;
}

/// Moves the corners of t, and where that is not enough the vertices round them.
bool Reshape::smooth_round(TriangleIndex t) {
  const std::array<VertexIndex, 3> corners = sheet_->triangle(t).vertex;
  bool moved = false;
  for (const VertexIndex v : corners)
    if (is_ill_shaped(t)) moved |= smooth(v);
  if (!is_ill_shaped(t)) return true;
  ring_.clear();
  for (const VertexIndex v : corners) {
    if (is_wide(*sheet_, v)) continue;
    for_each_outgoing(*sheet_, v, [&](HalfEdge h) {
      const VertexIndex w = sheet_->target(h);
      if (std::find(ring_.begin(), ring_.end(), w) == ring_.end()) ring_.push_back(w);
    });
  }
  for (const VertexIndex v : ring_) moved |= smooth(v);
  return moved;
}

/// Collapses the edge at a corner of t that leaves the best shapes, where these are better than t.
bool Reshape::shorten_in(TriangleIndex t) {
  const auto c = sheet_->corners(t);
  double least = aspect_ratio(c[0], c[1], c[2]);
  HalfEdge best;
  for (int k = 0; k < 3; ++k)
    for (const HalfEdge h : {half_edge(t, k), sheet_->opposite(half_edge(t, k))}) {
      if (!h.valid() || !may_leave_out(sheet_->origin(h), h)) continue;
      if (const double worst = worst_after_collapse(h); worst < least) {
        best = h;
        least = worst;
      }
    }
  if (!best.valid()) return false;
  const VertexIndex kept = sheet_->target(best);
  if (!sheet_->collapse(best)) return false;
  note_star(kept);
  return true;
}

/// Halves the edge of t that leaves the best shapes; a piece of the path at a point of the curve.
bool Reshape::split_in(TriangleIndex t) {
  HalfEdge best;
  Point2 at;
  double least = 4 * options_.max_aspect, parameter = -1;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k), o = sheet_->opposite(h);
    const Point2 a = sheet_->rest(sheet_->origin(h)), b = sheet_->rest(sheet_->target(h));
    if (squared_length(b - a) < 0.04 * h_ * h_) continue;
    Point2 middle = 0.5 * a + 0.5 * b;
    double s = -1;
    if (sheet_->mark(h) == EdgeMark::path) {
      const double from = curve_->parameter(sheet_->origin(h)), to = curve_->parameter(sheet_->target(h));
      if (curve_->may_divide(from, to, a, b, tolerance_)) {
        s = (from + to) / 2;
        middle = curve_->at(s);
      }
    }
    const auto halves = [&](HalfEdge side) {
      if (!side.valid()) return 0.0;
      const Point2 apex = sheet_->rest(sheet_->origin(Sheet::previous(side)));
      const Point2 from = sheet_->rest(sheet_->origin(side)), to = sheet_->rest(sheet_->target(side));
      if (orientation(from, middle, apex) <= 0 || orientation(middle, to, apex) <= 0) return 1e300;
      return std::max(aspect_ratio(from, middle, apex), aspect_ratio(middle, to, apex));
    };
    if (const double worst = std::max(halves(h), halves(o)); worst < least) {
      best = h;
      at = middle;
      least = worst;
      parameter = s;
    }
  }
  if (!best.valid()) return false;
  const VertexIndex v = split_at(best, at);
  if (!v.valid()) return false;
  if (parameter >= 0) curve_->add(v, parameter);
  note_star(v);
  return true;
}

/// Flips edges and moves corners of the ill-shaped triangles in the queue, which gets the triangles that this changes,
/// until the queue is empty or `most` triangles were processed.
void Reshape::process_queue(bool smoothing, std::size_t most) {
  for (std::size_t i = 0; i < queue_.size() && i < most; ++i) {
    const TriangleIndex t = queue_[i];
    if (!is_ill_shaped(t) || flip_one(t) || !smoothing) continue;
    const std::array<VertexIndex, 3> corners = sheet_->triangle(t).vertex;
    for (const VertexIndex v : corners)
      if (!is_ill_shaped(t) || smooth(v)) break;
  }
}

void Reshape::flip_and_smooth(bool smoothing) {
  find_wedges(smoothing);
  queue_ = changed_triangles();
  process_queue(smoothing, 20 * queue_.size());
}

/// Tries, for each ill-shaped triangle, the steps that add no or few vertices.
void Reshape::improve_one_by_one() {
  stuck_.clear();
  for (const TriangleIndex t : changed_triangles())
    if (is_ill_shaped(t)) stuck_.push_back(t);
  const std::size_t most = 50 + 4 * stuck_.size();
  for (std::size_t i = 0; i < std::min(most, stuck_.size()); ++i) {
    const TriangleIndex t = stuck_[i];
    for (int tries = 0; tries < 4 && is_ill_shaped(t); ++tries) {
      queue_.clear();
      if (!flip_one(t) && !shorten_in(t) && !smooth_round(t) && !split_in(t)) break;
      process_queue(true, 50);
      for (const TriangleIndex u : queue_)
        if (u != t && is_ill_shaped(u)) stuck_.push_back(u);
    }
  }
}

bool Reshape::refine() {
  improve_one_by_one();
  if (!stuck_.empty()) find_wedges(true);  // removed and moved vertices may have made new ones
  refinement_.begin(*sheet_, wedges_);
  for_each_changed(*sheet_, [&](TriangleIndex t) { refinement_.note(*sheet_, t); });
  return refinement_.run(*sheet_);
}

}  // namespace cutbench
