#include "harness/path/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/base/union_find.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

/// Shares of an edge nearer to its ends are the ends: a way through a vertex goes through it on both sides of a seam.
constexpr double at_the_end = 1e-9;
/// In mean edges: a straight way that arrives this near to its goal, by another chart's rounding, has arrived.
constexpr double arrived = 1e-6;
constexpr int most_splits = 8;
/// Lengths at rest and in space that differ by a smaller share are the same: parts lie beside each other in both.
constexpr double beside = 1e-3;

Point2 centroid(const Sheet& sheet, TriangleIndex t) {
  const auto [a, b, c] = sheet.corners(t);
  return (1.0 / 3) * (a + b + c);
}

Point2 at_share(const Sheet& sheet, HalfEdge h, double share) {
  const Point2 from = sheet.rest(sheet.origin(h)), to = sheet.rest(sheet.target(h));
  if (share <= at_the_end) return from;
  return share >= 1 - at_the_end ? to : from + share * (to - from);
}

bool holds(const Sheet& sheet, TriangleIndex t, Point2 p) {
  const auto corners = sheet.corners(t);
  for (std::size_t k = 0; k < 3; ++k)
    if (orientation(corners[k], corners[(k + 1) % 3], p) < 0) return false;
  return true;
}

}  // namespace

Router::Laying Router::Laying::after(const Laying& first) const {
  return {first.x.x * x + first.x.y * y, first.y.x * x + first.y.y * y, (*this)(first.shift)};
}

Router::Router(const Sheet& sheet) : sheet_(sheet), edges_(sewn_edges(sheet)), partners_(edges_.size()) {
  UnionFind joined(sheet.triangle_slots());
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(TriangleIndex(i), k);
          sheet.triangle(TriangleIndex(i)).alive() && !sheet.on_border(h))
        joined.join(i, triangle_of(sheet.opposite(h))());
  first_edge_.assign(4 * sheet.triangle_slots(), -1);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (std::int32_t& first = first_edge_[edges_[i].edge()]; first < 0) first = to_int32(i);
    for (std::size_t k = i + 1; k < edges_.size() && edges_[k].seam == edges_[i].seam; ++k) {
      const SewnEdge &a = edges_[i], &b = edges_[k];
      if (a.first == b.first || std::min(a.high(), b.high()) - std::max(a.low(), b.low()) <= seam_rounding) continue;
      partners_[i].push_back(k);
      partners_[k].push_back(i);
      joined.join(triangle_of(a.edge)(), triangle_of(b.edge)());
    }
  }
  part_.resize(sheet.triangle_slots());
  for (std::size_t i = 0; i < part_.size(); ++i) part_[i] = joined.find(i);
}

/// Nothing joins them, and a straight line at rest would lead through whatever lies between.
bool Router::are_apart(const PlaceAtRest& from, const PlaceAtRest& to) const {
  if (part_[from.triangle()] == part_[to.triangle()]) return false;
  const double at_rest = length(to.point - from.point), in_space = length(to.in_space + -1.0 * from.in_space);
  return std::abs(at_rest - in_space) > beside * std::max(at_rest, in_space);
}

std::vector<Router::Step> Router::steps_out_of(TriangleIndex t) const {
  std::vector<Step> steps;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (!sheet_.on_border(h)) {
      steps.push_back({h, sheet_.opposite(h)});
    } else if (const std::int32_t i = first_edge_[h()]; i >= 0) {
      for (const std::size_t partner : partners_[to_size(i)])
        steps.push_back({h, edges_[partner].edge, edges_[partner].seam});
    }
  }
  return steps;
}

/// The shortest one through the middles of triangles and edges (Dijkstra 1959); empty where there is none.
std::vector<Router::Step> Router::way(TriangleIndex from, TriangleIndex to) const {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<double> shortest(sheet_.triangle_slots(), std::numeric_limits<double>::infinity());
  std::vector<Step> last(sheet_.triangle_slots());
  shortest[from()] = 0;
  open.emplace(0, from());
  while (!open.empty()) {
    const auto [length_so_far, number] = open.top();
    const TriangleIndex t(number);
    open.pop();
    if (t == to) break;
    if (length_so_far > shortest[number]) continue;
    for (const Step& step : steps_out_of(t)) {
      const TriangleIndex next = triangle_of(step.in);
      const double all = length_so_far + length(at_share(sheet_, step.out, 0.5) - centroid(sheet_, t)) +
                         length(at_share(sheet_, step.in, 0.5) - centroid(sheet_, next));
      if (all >= shortest[next()]) continue;
      shortest[next()] = all;
      last[next()] = step;
      open.emplace(all, next());
    }
  }
  std::vector<Step> steps;
  if (from != to && !last[to()].out.valid()) return steps;
  for (TriangleIndex t = to; t != from; t = triangle_of(last[t()].out)) steps.push_back(last[t()]);
  std::reverse(steps.begin(), steps.end());
  return steps;
}

/// From the plane of the panel that is left to that of the one that is entered.
Router::Laying Router::across(const Step& step) const {
  if (!step.seam) return {};
  const SewnEdge &out = edges_[to_size(first_edge_[step.out()])], &in = edges_[to_size(first_edge_[step.in()])];
  const Seam& seam = sheet_.seams()[*step.seam];
  const auto& from = out.first ? seam.first : seam.second;
  const auto& to = out.first ? seam.second : seam.first;
  const Point2 u = from[1] - from[0], w = to[1] - to[0];
  const double size = length(u) * length(w);
  const bool turned_over = (out.begin < out.end) == (in.begin < in.end);
  // The rotation that takes u to w; before it, where one is turned over, the reflection in u.
  double c = dot(u, w) / size, s = cross(u, w) / size;
  Laying laying{{c, s}, {-s, c}, {}};
  if (turned_over) {
    const double square = squared_length(u), p = (u.x * u.x - u.y * u.y) / square, q = 2 * u.x * u.y / square;
    laying = laying.after({{p, q}, {q, -p}, {}});
  }
  laying.shift = to[0] - laying(from[0]);
  return laying;
}

/// Out over a seam at a share of the half-edge; none where nothing is sewn to it there.
std::optional<Router::Step> Router::over_seam(HalfEdge out, double share, Bend& bend) const {
  const std::int32_t i = first_edge_[out()];
  if (i < 0) return {};
  const SewnEdge& edge = edges_[to_size(i)];
  const double place = edge.begin + share * (edge.end - edge.begin);
  const SewnEdge* nearest = nullptr;
  double miss = seam_rounding;
  for (const std::size_t partner : partners_[to_size(i)]) {
    const SewnEdge& other = edges_[partner];
    const double off = std::max({other.low() - place, place - other.high(), 0.0});
    if (off > miss || (nearest && off >= miss)) continue;
    miss = off;
    nearest = &other;
  }
  if (!nearest) return {};
  const double there = std::clamp((place - nearest->begin) / (nearest->end - nearest->begin), 0.0, 1.0);
  bend = {at_share(sheet_, out, share), at_share(sheet_, nearest->edge, there), true};
  return Step{out, nearest->edge, nearest->seam};
}

/// The straight way that follows `way`, laid flat, as far as it goes straight on; none where it leads elsewhere.
std::optional<std::vector<Router::Bend>> Router::straight(const PlaceAtRest& from, const PlaceAtRest& to,
                                                          const std::vector<Step>& way) const {
  Laying laying;
  for (const Step& step : way)
    if (step.seam) laying = across(step).after(laying);
  const Point2 back = to.point - laying.shift;
  Point2 begin = from.point, goal{dot(laying.x, back), dot(laying.y, back)};
  if (begin == goal) return {};

  std::vector<Bend> bends;
  HalfEdge out;
  const auto corners = sheet_.corners(from.triangle);
  for (const int on_it : {0, 1})  // what lies on the line is left of it; where it then leads nowhere, right of it
    for (int k = 0; k < 3 && !out.valid(); ++k) {
      const int right = orientation(begin, goal, corners[to_size(k)]) - on_it;
      const int left = orientation(begin, goal, corners[to_size(next_corner(k))]) - on_it;
      if (right < 0 && left >= 0) out = half_edge(from.triangle, k);
    }
  TriangleIndex t = from.triangle;
  for (std::size_t steps = 0; out.valid() && steps < 10 * sheet_.triangle_slots(); ++steps) {
    if (t == to.triangle || holds(sheet_, t, goal)) {
      if (length(goal - to.point) > arrived * sheet_.mean_edge()) return {};
      return bends;
    }
    Step step{out, sheet_.opposite(out)};
    if (!step.in.valid()) {
      const double right = cross(goal - begin, sheet_.rest(sheet_.origin(out)) - begin);
      const double left = cross(goal - begin, sheet_.rest(sheet_.target(out)) - begin);
      Bend bend;
      const auto over = over_seam(out, right == left ? 0 : std::clamp(right / (right - left), 0.0, 1.0), bend);
      if (!over) return {};
      step = *over;
      bends.push_back(bend);
      goal = across(step)(goal);
      begin = bend.enters;
    }
    t = triangle_of(step.in);
    // In a triangle that is entered, the half-edge begins left of the way and ends right of it.
    const bool third_is_left = orientation(begin, goal, sheet_.rest(sheet_.origin(Sheet::previous(step.in)))) >= 0;
    out = third_is_left ? Sheet::next(step.in) : Sheet::previous(step.in);
  }
  return {};
}

/// Would a straight line at rest lead over a seam, as where a sheet that is curved leaves a gap between two sides?
bool Router::meets_seam(Point2 from, Point2 to) const {
  const auto parts = [](Point2 a, Point2 b, Point2 p, Point2 q) {
    return orientation(a, b, p) * orientation(a, b, q) < 0;
  };
  return std::any_of(edges_.begin(), edges_.end(), [&](const SewnEdge& edge) {
    const Point2 a = sheet_.rest(sheet_.origin(edge.edge)), b = sheet_.rest(sheet_.target(edge.edge));
    return parts(from, to, a, b) && parts(a, b, from, to);
  });
}

bool Router::join(const PlaceAtRest& from, const PlaceAtRest& to, int splits, std::vector<Bend>& bends) const {
  if (from.triangle == to.triangle) return true;
  const std::vector<Step> steps = way(from.triangle, to.triangle);
  if (steps.empty()) return false;
  if (const auto found = straight(from, to, steps)) {
    bends.insert(bends.end(), found->begin(), found->end());
    return true;
  }
  // In one panel it is straight at rest, as in a sheet without seams, also over holes.
  const bool in_one = std::none_of(steps.begin(), steps.end(), [](const Step& step) { return step.seam.has_value(); });
  if (in_one && !meets_seam(from.point, to.point)) return true;
  // A vertex with other than 360 degrees lies between the two ways: by the middle of the one along the triangles.
  if (steps.size() == 1) {
    const Point2 middle = at_share(sheet_, steps.front().out, 0.5);
    Bend bend{middle, middle, false};
    if (steps.front().seam) {
      const auto over = over_seam(steps.front().out, 0.5, bend);
      if (!over || triangle_of(over->in) != to.triangle) return false;
    }
    bends.push_back(bend);
    return true;
  }
  if (splits == 0) return false;
  const TriangleIndex t = triangle_of(steps[steps.size() / 2 - 1].in);
  const PlaceAtRest middle{t, centroid(sheet_, t)};
  if (!join(from, middle, splits - 1, bends)) return false;
  bends.push_back({middle.point, middle.point, false});
  return join(middle, to, splits - 1, bends);
}

std::vector<Curve> Router::route(const std::vector<PlaceAtRest>& places, bool closed, const std::string& name) const {
  std::vector<Curve> curves{{Curve::Kind::polyline, false, {places.front().point}}};
  const std::size_t ways = closed ? places.size() : places.size() - 1;
  for (std::size_t i = 0; i < ways; ++i) {
    const std::size_t next = (i + 1) % places.size();
    std::vector<Bend> bends;
    const std::string which = name + ", points " + std::to_string(i) + " and " + std::to_string(next);
    if (are_apart(places[i], places[next]))
      throw InputError(which +
                       ": nothing joins the parts they are on; give each a path of its own, or sew them (--sew)");
    const bool is_in_one = part_[places[i].triangle()] == part_[places[next].triangle()];
    if (has_seams() && is_in_one && !join(places[i], places[next], most_splits, bends))
      throw InputError(which + ": no straight way over seams leads from one to the other; put points between them");
    for (const Bend& bend : bends) {
      curves.back().points.push_back(bend.leaves);
      if (bend.seam) curves.push_back({Curve::Kind::polyline, false, {bend.enters}});
    }
    if (next != 0) curves.back().points.push_back(places[next].point);
  }
  if (!closed) return curves;
  if (curves.size() == 1) {
    curves.front().closed = true;
    return curves;
  }
  // The last one ends where the first one begins.
  const std::vector<Point2>& first = curves.front().points;
  curves.back().points.insert(curves.back().points.end(), first.begin(), first.end());
  curves.erase(curves.begin());
  return curves;
}

}  // namespace cutbench
