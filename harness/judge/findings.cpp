#include "harness/judge/findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "harness/judge/lost_digits.h"
#include "harness/measure/clip.h"
#include "harness/measure/exact.h"
#include "harness/measure/flatten.h"
#include "harness/measure/search.h"
#include "harness/measure/sheet_topology.h"

namespace cutbench {

namespace {

using oracle::area, oracle::between, oracle::bow_ties, oracle::distance, oracle::dot, oracle::minus, oracle::next;
using oracle::Mesh;
using oracle::orientation, oracle::segment;
using oracle::Point;
using oracle::Segment;

std::string number(double x, const char* format = "%.10g") {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}
std::string at(const Point& p) { return "(" + number(p[0]) + ", " + number(p[1]) + ")"; }

class Causes {
 public:
  Causes(const oracle::Request& request, const Mesh& after, const oracle::Judgement& judgement)
      : request_(request), before_(request.before), after_(after), judgement_(judgement) {}

  std::vector<Finding> find() {
    if (judgement_.verdict == "not_finite" || judgement_.verdict == "bad_index") return {other()};
    before_edges_ = oracle::half_edges(before_), edges_ = oracle::half_edges(after_);
    h_ = oracle::edge_lengths(before_, before_edges_).mean;
    compare_places();
    std::vector<Finding> all;
    const auto try_one = [&](std::optional<Finding> found) {
      if (found && all.empty()) all.push_back(std::move(*found));
    };
    try_one(rounded());
    if (judgement_.ok) return with_cuts(all);
    try_one(other_rest());
    if (request_.keeps_vertices && all.empty()) try_one(moved_vertex());
    if (all.empty()) try_one(flipped());
    if (!edges_.repeated.empty() && all.empty()) return {other()};
    if (all.empty() && request_.keeps_area) look_at_borders(try_one);
    if (all.empty()) all.push_back(other());
    return with_cuts(all);
  }

 private:
  template <class Try>
  void look_at_borders(Try try_one) {
    borders_ = oracle::borders(after_, edges_);
    std::vector<Segment> outline;
    for (const int e : oracle::borders(before_, before_edges_).single) outline.push_back(segment(before_, e));
    const oracle::SegmentSearch search(outline);
    for (const int e : borders_.single)
      if (!search.covers(segment(after_, e), request_.snap + 1e-12 * h_)) loose_.push_back(e);
    try_one(lips_differ());
    try_one(t_junction());
    try_one(lost_triangle());
    try_one(one_vertex());
    try_one(beside_path());
    try_one(extra_pieces());
    try_one(not_opened());
    try_one(lost_loop());
    try_one(pieces("pieces", "open the whole path, and nothing beside it"));
  }

  void compare_places() {
    const std::vector<int> unused = oracle::unused_vertices(before_);
    std::set<Point> had, has(after_.rest.begin(), after_.rest.end());
    for (int v = 0; v < static_cast<int>(before_.rest.size()); ++v)
      if (!std::binary_search(unused.begin(), unused.end(), v)) had.insert(before_.rest[v]);
    places_before_ = had.size();
    for (const Point& p : had)
      if (!has.contains(p)) gone_.push_back(p);
    for (const Point& p : has)
      if (!had.contains(p)) new_.push_back(p);
  }

  std::optional<Finding> rounded() const {
    std::string how;
    Point worst{};
    double farthest = -1;
    if (!new_.empty() && 2 * gone_.size() >= places_before_) {
      std::vector<Segment> places;
      for (const Point& p : new_) places.push_back({p, p});
      const oracle::SegmentSearch search(places);
      std::size_t close = 0;
      for (const Point& p : gone_)
        if (const double d = search.distance(p); d <= 1e-4 * h_) {
          ++close;
          if (d > farthest) farthest = d, worst = p;
        }
      if (10 * close < 9 * gone_.size()) return {};
      how = std::to_string(close) + " of " + std::to_string(places_before_) +
            " vertices of the sheet are off their place by up to " + number(farthest, "%.2g") + " (" +
            number(farthest / h_, "%.1g") + " h), the most at " + at(worst);
    } else {
      const std::string digits = lost_digits(new_);
      if (digits.empty()) return {};
      how = "all " + std::to_string(new_.size()) + " new vertices have coordinates " + digits + ", the first at " +
            at(new_.front());
      worst = new_.front();
    }
    return Finding{
        "rounded", how + ": rest positions were rounded",
        "compute and write rest positions in double precision, with 17 digits (%.17g), and leave those of the "
        "sheet as they were read",
        worst};
  }

  std::optional<Finding> other_rest() const {
    if (10 * gone_.size() < 9 * places_before_ || judgement_.verdict == "wrong_pieces" ||
        judgement_.verdict == "incision")
      return {};
    return Finding{
        "other_rest",
        "of " + std::to_string(places_before_) + " vertices of the sheet " +
            std::to_string(places_before_ - gone_.size()) + " are where they were at rest",
        "write the rest positions as `vt`, or a flat mesh whose `v` they are; check that it is a result of this sheet",
        {}};
  }

  std::optional<Finding> moved_vertex() const {
    for (std::size_t v = 0; v < before_.rest.size(); ++v) {
      const Point& was = before_.rest[v];
      if (v < after_.rest.size() && after_.rest[v] == was) continue;
      const std::string name = "vertex " + std::to_string(v) + " of the sheet, at " + at(was) + ", ";
      const auto same = std::find(after_.rest.begin(), after_.rest.end(), was);
      std::string text = name + "is not in the result";
      if (same != after_.rest.end())
        text = name + "is vertex " + std::to_string(same - after_.rest.begin()) + " of the result";
      else if (v < after_.rest.size())
        text = name + "is at " + at(after_.rest[v]) + " in the result, " +
               number(distance(was, after_.rest[v]) / h_, "%.3g") + " h away";
      return Finding{"moved_vertex", text,
                     "leave the sheet's vertices where they are, with their numbers; put new ones behind them", was};
    }
    return {};
  }

  Point centre(int t) const {
    Point c{0, 0};
    for (const int v : after_.triangles[t])
      for (std::size_t i = 0; i < 2; ++i) c[i] += after_.rest[v][i] / 3;
    return c;
  }
  std::string name(int t) const {
    const auto& [a, b, c] = after_.triangles[t];
    return "triangle " + std::to_string(t) + " (" + std::to_string(a) + " " + std::to_string(b) + " " +
           std::to_string(c) + ") at " + at(centre(t));
  }

  std::optional<Finding> flipped() const {
    if (every_triangle_turns_back())
      return Finding{"flipped", "every triangle has its corners in clockwise order", "swap two corners of each", {}};
    std::optional<Finding> folded;
    for (int t = 0; t < static_cast<int>(after_.triangles.size()); ++t) {
      const auto& [a, b, c] = after_.triangles[t];
      const int turn = orientation(after_.rest[a], after_.rest[b], after_.rest[c]);
      if (turn > 0) continue;
      const bool against = turn < 0 && runs_against_neighbours(t);
      if (against)
        return Finding{"flipped", name(t) + " has its corners in clockwise order", "swap two of its corners",
                       centre(t)};
      if (!folded)
        folded = Finding{
            "folded", name(t) + (turn < 0 ? " is turned over" : " has no area") + " at rest",
            "a corner of it lies across the opposite edge, or on it: move that corner back, or divide otherwise",
            centre(t)};
    }
    return folded;
  }

  bool every_triangle_turns_back() const {
    return std::all_of(after_.triangles.begin(), after_.triangles.end(), [this](const auto& t) {
      return orientation(after_.rest[t[0]], after_.rest[t[1]], after_.rest[t[2]]) < 0;
    });
  }

  /// A neighbour has an edge in the same direction, or all of its edges are alone.
  bool runs_against_neighbours(int t) const {
    const auto mine = [t](int e) { return e / 3 == t; };
    return std::any_of(edges_.repeated.begin(), edges_.repeated.end(), mine) ||
           (edges_.opposite[3 * t] < 0 && edges_.opposite[3 * t + 1] < 0 && edges_.opposite[3 * t + 2] < 0);
  }

  // --- edges that are border, and should not be ----------------------------------------------------------------------

  int from(int e) const { return after_.triangles[e / 3][static_cast<std::size_t>(e % 3)]; }
  int to(int e) const { return from(next(e)); }

  std::optional<Finding> lips_differ() const {
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
          worst = Finding{"lips_differ",
                          "vertices " + std::to_string(v) + " and " + std::to_string(w) + ", the two lips' at " +
                              at(after_.rest[v]) + ", are " + number(d, "%.2g") + " apart (" + number(d / h_, "%.1g") +
                              " h)",
                          "give both lips the very same rest position: compute it once, and write it with 17 digits",
                          after_.rest[v]};
        }
      }
    return worst;
  }

  std::optional<Finding> t_junction() const {
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

  std::optional<Finding> lost_triangle() const {
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
      corners.insert(a), corners.insert(b);
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

  // --- vertices and the path -----------------------------------------------------------------------------------------

  std::optional<Finding> one_vertex() const {
    const std::vector<int> ties = bow_ties(after_, edges_);
    if (ties.empty()) return {};
    const Point& p = after_.rest[ties.front()];
    return Finding{"one_vertex",
                   "vertex " + std::to_string(ties.front()) + " at " + at(p) +
                       " joins triangles that share no edge: the two sides of a cut hang together there",
                   "give each side its own vertex at that place", p};
  }

  std::vector<Segment> path_of(std::size_t cut) const {
    std::vector<Segment> path;
    for (const auto& s : oracle::flatten(request_.cuts[cut], 1e-5 * h_)) path.push_back(s.segment);
    return oracle::near_mesh(path, before_);
  }
  std::vector<Segment> whole_path() const {
    std::vector<Segment> all;
    for (std::size_t i = 0; i < request_.cuts.size(); ++i)
      for (const Segment& s : path_of(i)) all.push_back(s);
    return all;
  }

  double allowed() const {
    return std::min(request_.tolerance, oracle::edge_lengths(before_, before_edges_).longest) + 1e-4 * h_;
  }

  /// The point of the segments, where `counts`, that is farthest from the others.
  template <class Counts>
  std::pair<double, Point> farthest(const std::vector<Segment>& segments, const oracle::SegmentSearch& others,
                                    Counts counts) const {
    std::pair<double, Point> result{-1, {}};
    for (const Segment& s : segments) {
      const int steps = static_cast<int>(std::ceil(distance(s[0], s[1]) / (0.02 * h_)));
      for (int i = 0; i <= steps; ++i) {
        const Point p = between(s[0], s[1], steps == 0 ? 0.0 : static_cast<double>(i) / steps);
        if (const double d = others.distance(p); d > result.first && counts(p)) result = {d, p};
      }
    }
    return result;
  }

  std::vector<Segment> older() const {
    std::vector<Segment> all;
    for (const auto& lips : oracle::borders(before_, before_edges_).lips) all.push_back(segment(before_, lips[0]));
    return all;
  }

  std::optional<Finding> beside_path() const {
    std::vector<Segment> added;
    const oracle::SegmentSearch open_before(older()), path(whole_path());
    for (const auto& lips : borders_.lips)
      if (!open_before.covers(segment(after_, lips[0]), request_.snap + 1e-12 * h_))
        added.push_back(segment(after_, lips[0]));
    const auto [off, place] = farthest(added, path, [](const Point&) { return true; });
    if (off <= allowed()) return {};
    return Finding{"shifted",
                   "the incision at " + at(place) + " lies " + number(off / h_, "%.3g") +
                       " h beside the path (allowed: " + number(allowed() / h_, "%.3g") + " h)",
                   "open edges along the path itself; check that it is read in rest positions", place};
  }

  std::optional<Finding> not_opened() const {
    std::vector<Segment> open;
    for (std::size_t e = 0; e < edges_.opposite.size(); ++e)
      if (edges_.opposite[e] < 0) open.push_back(segment(after_, static_cast<int>(e)));
    const oracle::TriangleSearch sheet(before_);
    auto [off, place] =
        farthest(whole_path(), oracle::SegmentSearch(open), [&](const Point& p) { return sheet.holds(p); });
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

  /// The inner edge between two border vertices that lies nearest to the path for its length; -1: none.
  int closed_edge() const {
    std::vector<char> on_border(after_.rest.size(), 0);
    for (std::size_t e = 0; e < edges_.opposite.size(); ++e)
      if (edges_.opposite[e] < 0) on_border[from(static_cast<int>(e))] = on_border[to(static_cast<int>(e))] = 1;
    const oracle::SegmentSearch path(whole_path());
    int best = -1;
    double least = 0.2;
    for (int e = 0; e < static_cast<int>(edges_.opposite.size()); ++e) {
      if (edges_.opposite[e] < e || !on_border[from(e)] || !on_border[to(e)]) continue;
      const Segment s = segment(after_, e);
      double off = 0;
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) off = std::max(off, path.distance(between(s[0], s[1], t)));
      if (const double share = off / distance(s[0], s[1]); share < least) least = share, best = e;
    }
    return best;
  }

  // --- pieces --------------------------------------------------------------------------------------------------------

  struct Piece {
    double area = 0;
    int largest = 0;  // triangle
    double largest_area = -1;
  };
  std::vector<Piece> all_pieces(const std::vector<int>& piece) const {
    std::vector<Piece> all(static_cast<std::size_t>(judgement_.pieces));
    for (int t = 0; t < static_cast<int>(piece.size()); ++t) {
      const double a = area_of(t);
      Piece& p = all[piece[t]];
      p.area += a;
      if (a > p.largest_area) p.largest_area = a, p.largest = t;
    }
    return all;
  }
  double area_of(int t) const {
    const auto& [a, b, c] = after_.triangles[t];
    return oracle::cross(minus(after_.rest[b], after_.rest[a]), minus(after_.rest[c], after_.rest[a])) / 2;
  }

  /// The smallest pieces, where there is another number of them than the path makes.
  std::optional<Finding> pieces(const char* cause, const char* mend) const {
    if (judgement_.verdict != "wrong_pieces") return {};
    std::vector<Piece> all = all_pieces(oracle::pieces_of_triangles(edges_));
    std::sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
    std::string text = std::to_string(judgement_.pieces) + " pieces instead of " +
                       std::to_string(judgement_.expected_pieces) + "; the smallest:";
    for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 3); ++i)
      text += (i > 0 ? ", area " : " area ") + number(all[i].area, "%.3g") + " round " + at(centre(all[i].largest));
    return Finding{cause, text, mend, centre(all.front().largest)};
  }

  std::optional<Finding> extra_pieces() const {
    if (judgement_.pieces <= judgement_.expected_pieces) return {};
    return pieces("extra_pieces",
                  "nothing but the path parts triangles: give the triangles on both sides of every other edge the same "
                  "vertices");
  }

  /// The smallest closed cut whose middle lies in a piece much larger than what it cuts out.
  std::optional<Finding> lost_loop() const {
    if (judgement_.verdict != "wrong_pieces" || judgement_.pieces >= judgement_.expected_pieces) return {};
    const std::vector<int> piece = oracle::pieces_of_triangles(edges_);
    const std::vector<Piece> all = all_pieces(piece);
    double smallest = std::numeric_limits<double>::infinity();
    Point place{};
    for (std::size_t cut = 0; cut < request_.cuts.size(); ++cut) {
      const std::vector<Segment> path = path_of(cut);
      if (path.empty() || path.front()[0] != path.back()[1]) continue;
      double twice = 0;
      Point middle{0, 0};
      for (const auto& [a, b] : path) {
        twice += oracle::cross(minus(a, path.front()[0]), minus(b, path.front()[0]));
        for (std::size_t i = 0; i < 2; ++i) middle[i] += a[i] / static_cast<double>(path.size());
      }
      const double inside = std::abs(twice) / 2;
      for (int t = 0; t < static_cast<int>(piece.size()); ++t)
        if (holds(t, middle) && all[piece[t]].area > 2 * inside && inside < smallest) smallest = inside, place = middle;
    }
    if (!std::isfinite(smallest)) return {};
    return Finding{
        "lost_loop",
        std::to_string(judgement_.pieces) + " pieces instead of " + std::to_string(judgement_.expected_pieces) +
            ": the closed cut round " + at(place) + " cuts out an area of " + number(smallest, "%.3g") +
            ", which is no piece of its own",
        "a small loop must not shrink to a point or a line: give it three vertices at least, and open all its "
        "edges",
        place};
  }
  bool holds(int t, const Point& p) const {
    const auto& [a, b, c] = after_.triangles[t];
    return orientation(after_.rest[a], after_.rest[b], p) >= 0 && orientation(after_.rest[b], after_.rest[c], p) >= 0 &&
           orientation(after_.rest[c], after_.rest[a], p) >= 0;
  }

  Finding other() const {
    return {"other",
            judgement_.problems.empty() ? judgement_.verdict : judgement_.problems.front(),
            "see the verdict in results/README.md",
            {}};
  }

  std::vector<Finding> with_cuts(std::vector<Finding> all) const {
    for (Finding& f : all) {
      if (!f.place) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < request_.cuts.size(); ++i)
        if (const double d = oracle::SegmentSearch(path_of(i)).distance(*f.place); f.cut == 0 || d < nearest)
          nearest = d, f.cut = static_cast<int>(i) + 1;
    }
    return all;
  }

  const oracle::Request& request_;
  const Mesh &before_, &after_;
  const oracle::Judgement& judgement_;
  oracle::HalfEdges before_edges_, edges_;
  oracle::Borders borders_;
  double h_ = 0;
  std::size_t places_before_ = 0;
  std::vector<Point> gone_, new_;  // places of the sheet that the result lacks, and those that only it has
  std::vector<int> loose_;         // border half-edges of the result that are neither on the outline nor a lip
};

}  // namespace

std::vector<Finding> find_causes(const oracle::Request& request, const oracle::Mesh& after,
                                 const oracle::Judgement& judgement) {
  return Causes(request, after, judgement).find();
}

}  // namespace cutbench
