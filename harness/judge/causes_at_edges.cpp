// Causes at edges: those that are border and should not be, and those that lie beside the path or are closed on it.
#include <algorithm>
#include <cmath>
#include <set>

#include "harness/base/conversions.h"
#include "harness/judge/causes.h"
#include "harness/oracle/clip.h"
#include "harness/oracle/flatten.h"

namespace cutbench::causes {

// --- edges that are border, and should not be ------------------------------------------------------------------------

std::optional<Finding> Causes::lips_differ() const {
  std::optional<Finding> worst;
  double most = 0;
  for (const int e : loose_)
    for (const int f : loose_) {
      if (e >= f) continue;
      for (const auto& [v, w] : {std::pair{from(e), to(f)}, std::pair{to(e), from(f)}}) {
        const double first = distance(after_.rest[from(e)], after_.rest[to(f)]);
        const double second = distance(after_.rest[to(e)], after_.rest[from(f)]);
        const double d = distance(after_.rest[v], after_.rest[w]);
        if (std::max(first, second) > 1e-3 * h_ || after_.rest[v] == after_.rest[w] || d < most) continue;
        most = d;
        worst = Finding{
            "lips_differ",
            "vertices " + std::to_string(v) + " and " + std::to_string(w) + ", the two lips' at " + at(after_.rest[v]) +
                ", are " + number(d, "%.2g") + " apart (" + number(d / h_, "%.1g") + " h)",
            "give both lips the very same rest position: compute it once, and write it with 17 digits", after_.rest[v]};
      }
    }
  return worst;
}

std::optional<Finding> Causes::t_junction() const {
  for (const int e : loose_) {
    const Segment s = segment(after_, e);
    for (const int f : loose_) {
      const Point& p = after_.rest[from(f)];
      const double along = dot(minus(p, s[0]), minus(s[1], s[0])) / std::pow(distance(s[0], s[1]), 2);
      if (f == e || along < 1e-6 || along > 1 - 1e-6 || distance(p, s) > 1e-6 * h_) continue;
      return Finding{"t_junction",
                     "vertex " + std::to_string(from(f)) + " at " + at(p) + " lies on the edge " +
                         std::to_string(from(e)) + "-" + std::to_string(to(e)) + " of " + name(e / 3) +
                         ", which it does not divide",
                     "divide that triangle at the vertex, too: both sides of an edge get the same vertices", p};
    }
  }
  return {};
}

std::optional<Finding> Causes::lost_triangle() const {
  if (loose_.empty() || area(after_) >= area(before_) * (1 - 1e-13L)) return {};
  const oracle::TriangleSearch was(before_), is(after_);
  std::set<Point> corners;
  std::optional<Point> place;
  for (const int e : loose_) {
    const auto& [a, b] = segment(after_, e);
    const Point along = minus(b, a), middle = between(a, b, 0.5);
    const Point outside{middle[0] + 1e-4 * along[1], middle[1] - 1e-4 * along[0]};
    if (!was.holds(outside) || is.holds(outside)) continue;
    if (!place) place = outside;
    corners.insert(a);
    corners.insert(b);
  }
  if (!place) return {};
  std::string which = "no triangle covers the place beside " + at(*place);
  if (corners.size() == 3) {
    Point centre{0, 0};
    which = "the triangle with the corners";
    for (const Point& p : corners) {
      which += " " + at(p);
      for (std::size_t i = 0; i < 2; ++i) centre[i] += p[i] / 3;
    }
    which += " is missing";
    place = centre;
  }
  return Finding{"lost_triangle", which,
                 "write every triangle: those that the cut leaves alone, and all parts of those it divides", place};
}

// --- vertices and the path -------------------------------------------------------------------------------------------

std::optional<Finding> Causes::unused_copy() const {
  const std::vector<int> unused = oracle::unused_vertices(after_);
  for (const int v : unused)
    for (int w = 0; w < to_int(after_.rest.size()); ++w)
      if (after_.rest[w] == after_.rest[v] && !std::binary_search(unused.begin(), unused.end(), w) &&
          judgement_.verdict == Verdict::unused_vertex)
        return Finding{"doubled",
                       "vertex " + std::to_string(v) + " at " + at(after_.rest[v]) + " is a copy of vertex " +
                           std::to_string(w) + " that no triangle has",
                       "leave it out, or give it to the triangles on one side of the path", after_.rest[v]};
  return {};
}

/// An edge that is parted though it leads away from the path, from a vertex on it, while the path is opened: the two
/// triangles have copies of that vertex of their own.
std::optional<Finding> Causes::doubled() const {
  if (request_.cuts.empty() || farthest_from_open().first > allowed()) return {};
  const oracle::SegmentSearch open_before(older()), path(whole_path());
  const double on = std::min(request_.vertex_tolerance, request_.tolerance) + request_.rounding + 1e-4 * h_;
  const auto is_on = [&](const Point& p) { return path.distance(p) <= on; };
  for (const auto& [e, f] : borders_.lips) {
    const Segment s = segment(after_, e);
    if (is_on(s[0]) == is_on(s[1]) || open_before.covers(s, request_.snap + 1e-12 * h_)) continue;
    const bool at_start = is_on(s[0]);
    const int v = at_start ? from(e) : to(e), w = at_start ? to(f) : from(f);
    if (v == w) continue;
    return Finding{"doubled",
                   "vertices " + std::to_string(v) + " and " + std::to_string(w) + " are both at " +
                       at(after_.rest[v]) + " on one side of the path: the edge from there to " +
                       at(s[at_start ? 1 : 0]) + " is parted, which the path does not part",
                   "give all triangles on one side of the path the same vertex there", after_.rest[v]};
  }
  return {};
}

std::optional<Finding> Causes::one_vertex() const {
  const std::vector<int> constraints = bow_ties(after_, edges_);
  if (constraints.empty()) return {};
  const Point& p = after_.rest[constraints.front()];
  return Finding{"one_vertex",
                 "vertex " + std::to_string(constraints.front()) + " at " + at(p) +
                     " joins triangles that share no edge: the two sides of a cut hang together there",
                 "give each side its own vertex at that place", p};
}

std::vector<Segment> Causes::path_of(std::size_t cut) const {
  std::vector<Segment> path;
  for (const auto& s : oracle::flatten(request_.cuts[cut], 1e-5 * h_)) path.push_back(s.segment);
  return oracle::near_mesh(path, before_);
}
std::vector<Segment> Causes::whole_path() const {
  std::vector<Segment> all;
  for (std::size_t i = 0; i < request_.cuts.size(); ++i)
    for (const Segment& s : path_of(i)) all.push_back(s);
  return all;
}

double Causes::allowed() const {
  return std::min(request_.tolerance, oracle::edge_lengths(before_, before_edges_).longest) + 1e-4 * h_;
}

template <class Counts>
std::pair<double, Point> Causes::farthest(const std::vector<Segment>& segments, const oracle::SegmentSearch& others,
                                          Counts counts) const {
  std::pair<double, Point> result{-1, {}};
  for (const Segment& s : segments) {
    const int steps = to_int(std::ceil(distance(s[0], s[1]) / (0.02 * h_)));
    for (int i = 0; i <= steps; ++i) {
      const Point p = between(s[0], s[1], steps == 0 ? 0.0 : to_double(i) / steps);
      if (const double d = others.distance(p); d > result.first && counts(p)) result = {d, p};
    }
  }
  return result;
}

std::vector<Segment> Causes::older() const {
  std::vector<Segment> all;
  for (const auto& lips : oracle::borders(before_, before_edges_).lips) all.push_back(segment(before_, lips[0]));
  return all;
}

std::optional<Finding> Causes::beside_path() const {
  std::vector<Segment> added;
  const oracle::SegmentSearch open_before(older()), path(whole_path());
  for (const auto& lips : borders_.lips)
    if (!open_before.covers(segment(after_, lips[0]), request_.snap + 1e-12 * h_))
      added.push_back(segment(after_, lips[0]));
  const auto [off, place] = farthest(added, path, [](const Point&) { return true; });
  if (off <= allowed()) return {};
  if (!std::isfinite(off))
    return Finding{"shifted", "the result has an incision at " + at(place) + ", but the path misses the sheet",
                   "check that the path is read in rest positions, in the unit of the sheet", place};
  return Finding{"shifted",
                 "the incision at " + at(place) + " lies " + number(off / h_, "%.3g") +
                     " h beside the path (allowed: " + number(allowed() / h_, "%.3g") + " h)",
                 "open edges along the path itself; check that it is read in rest positions", place};
}

std::pair<double, Point> Causes::farthest_from_open() const {
  std::vector<Segment> open;
  for (std::size_t e = 0; e < edges_.opposite.size(); ++e)
    if (edges_.opposite[e] < 0) open.push_back(segment(after_, to_int(e)));
  const oracle::TriangleSearch sheet(before_);
  return farthest(whole_path(), oracle::SegmentSearch(open), [&](const Point& p) { return sheet.holds(p); });
}

std::optional<Finding> Causes::not_opened() const {
  auto [off, place] = farthest_from_open();
  std::string where = "the path at " + at(place) + " is not opened";
  if (off <= allowed()) {
    const int e = closed_edge();
    if (e < 0) return {};
    const Segment s = segment(after_, e);
    place = between(s[0], s[1], 0.5);
    where = "the edge " + std::to_string(from(e)) + "-" + std::to_string(to(e)) + " at " + at(place) +
            " lies on the path, and its two triangles still hang together";
  } else {
    where += ": " + number(off / h_, "%.3g") + " h from there to the nearest open edge";
  }
  return Finding{"not_opened", where, "give the triangles on both sides of the path vertices of their own there",
                 place};
}

int Causes::closed_edge() const {
  std::vector<char> on_border(after_.rest.size(), 0);
  for (std::size_t e = 0; e < edges_.opposite.size(); ++e)
    if (edges_.opposite[e] < 0) on_border[from(to_int(e))] = on_border[to(to_int(e))] = 1;
  const oracle::SegmentSearch path(whole_path());
  int best = -1;
  double least = 0.2;
  for (int e = 0; e < to_int(edges_.opposite.size()); ++e) {
    if (edges_.opposite[e] < e || !on_border[from(e)] || !on_border[to(e)]) continue;
    const Segment s = segment(after_, e);
    double off = 0;
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) off = std::max(off, path.distance(between(s[0], s[1], t)));
    if (const double share = off / distance(s[0], s[1]); share < least) {
      least = share;
      best = e;
    }
  }
  return best;
}

}  // namespace cutbench::causes
