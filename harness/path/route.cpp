#include "harness/path/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/base/products_in_space.h"
#include "harness/base/union_find.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

/// Shares of an edge nearer to its ends are the ends: a way through a vertex goes through it on both sides of a seam.
constexpr double at_the_end = 1e-9;
/// Lengths at rest and in space that differ by a smaller share are the same: parts lie beside each other in both.
constexpr double beside = 1e-3;

/// Does a line share more than a point with a side? \param near  what is nearer is on it
bool runs_along(Point2 from, Point2 to, Point2 begin, Point2 end, double near) {
  const Point2 way = (1 / length(end - begin)) * (end - begin);
  const auto off = [&](Point2 p) { return std::abs(cross(way, p - begin)); };
  const auto [low, high] = std::minmax({dot(way, from - begin), dot(way, to - begin)});
  return off(from) <= near && off(to) <= near && std::min(high, length(end - begin)) - std::max(low, 0.0) > near;
}

bool holds(const Sheet& sheet, TriangleIndex t, Point2 p) {
  const auto corners = sheet.corners(t);
  for (std::size_t k = 0; k < 3; ++k)
    if (orientation(corners[k], corners[(k + 1) % 3], p) < 0) return false;
  return true;
}

}  // namespace

Point2 Router::at_share(HalfEdge h, double share) const {
  const Point2 from = sheet_.rest(sheet_.origin(h)), to = sheet_.rest(sheet_.target(h));
  if (share <= at_the_end) return from;
  return share >= 1 - at_the_end ? to : from + share * (to - from);
}

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
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    by_x_.push_back(i);
    widest_ = std::max(widest_, sides(i).second - sides(i).first);
  }
  std::sort(by_x_.begin(), by_x_.end(),
            [this](std::size_t a, std::size_t b) { return sides(a).first < sides(b).first; });
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

/// Dijkstra's (1959) over points on the edges, a few on each, joined by straight lines in the triangles between them.
/// It says which triangles a way leads through that is a few percent longer than the shortest one. Empty where there is
/// none.
std::vector<Router::Step> Router::way(const PlaceAtRest& from, const PlaceAtRest& to) const {
  constexpr std::array shares{0.1, 0.3, 0.5, 0.7, 0.9};  // of the part of an edge that a step leads through
  constexpr std::uint64_t none = 0;
  struct Reached {
    Step step;
    Point2 enters;  // in the plane of the triangle that it enters
    double length;  // up to there
    std::uint64_t before;
  };
  const auto key = [&](const Step& step, std::size_t i) {
    return (std::uint64_t{to_size(step.out())} << 32 | (to_size(step.in()) * shares.size() + i)) + 1;
  };
  using Entry = std::pair<double, std::uint64_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::unordered_map<std::uint64_t, Reached> reached;
  double shortest = std::numeric_limits<double>::infinity();
  std::uint64_t last = none;
  const auto leave = [&](TriangleIndex t, Point2 begin, double before, std::uint64_t where) {
    for (const Step& step : steps_out_of(t)) {
      const Gate through = gate(step);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto at = [&](const std::array<double, 2>& ends) { return ends[0] + shares[i] * (ends[1] - ends[0]); };
        const double all = before + length(at_share(step.out, at(through.out)) - begin);
        if (all >= shortest) continue;
        const auto [place, is_new] = reached.try_emplace(key(step, i));
        if (!is_new && all >= place->second.length) continue;
        place->second = {step, at_share(step.in, at(through.in)), all, where};
        open.emplace(all, place->first);
      }
    }
  };
  leave(from.triangle, from.point, 0, none);
  while (!open.empty() && open.top().first < shortest) {
    const auto [all, where] = open.top();
    open.pop();
    const Reached here = reached.at(where);
    if (all > here.length) continue;
    const TriangleIndex t = triangle_of(here.step.in);
    if (t != to.triangle) {
      leave(t, here.enters, all, where);
    } else if (const double arrives = all + length(to.point - here.enters); arrives < shortest) {
      shortest = arrives;
      last = where;
    }
  }
  std::vector<Step> steps;
  for (; last != none; last = reached.at(last).before) steps.push_back(reached.at(last).step);
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
  bend = {at_share(out, share), at_share(nearest->edge, there), true};
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
  const double low = std::min(from.x, to.x) - widest_, high = std::max(from.x, to.x);
  const auto begins = [this](std::size_t i) { return sides(i).first; };
  auto i = std::partition_point(by_x_.begin(), by_x_.end(), [&](std::size_t edge) { return begins(edge) < low; });
  for (; i != by_x_.end() && begins(*i) <= high; ++i) {
    const HalfEdge edge = edges_[*i].edge;
    const Point2 a = sheet_.rest(sheet_.origin(edge)), b = sheet_.rest(sheet_.target(edge));
    if (parts(from, to, a, b) && parts(a, b, from, to)) return true;
  }
  return false;
}

/// The least and the largest x of an edge on a seam.
std::pair<double, double> Router::sides(std::size_t edge) const {
  const HalfEdge h = edges_[edge].edge;
  return std::minmax({sheet_.rest(sheet_.origin(h)).x, sheet_.rest(sheet_.target(h)).x});
}

/// With which a line at rest shares more than a point.
std::vector<HalfEdge> Router::seams_along(Point2 from, Point2 to) const {
  const double near = arrived * sheet_.mean_edge();
  const auto begins_before = [&](std::size_t edge) {
    return sides(edge).first < std::min(from.x, to.x) - widest_ - near;
  };
  const auto first = std::partition_point(by_x_.begin(), by_x_.end(), begins_before);
  const auto last = std::find_if(first, by_x_.end(),
                                 [&](std::size_t edge) { return sides(edge).first > std::max(from.x, to.x) + near; });
  std::vector<HalfEdge> along;
  for (const std::size_t i : std::span(first, last)) {
    const HalfEdge h = edges_[i].edge;
    if (runs_along(from, to, sheet_.rest(sheet_.origin(h)), sheet_.rest(sheet_.target(h)), near)) along.push_back(h);
  }
  return along;
}

std::vector<HalfEdge> Router::seams_along(const PlaceAtRest& from, const PlaceAtRest& to,
                                          const std::vector<Bend>& bends) const {
  std::vector<HalfEdge> along;
  const auto add = [&](Point2 begin, Point2 end) {
    const std::vector<HalfEdge> more = seams_along(begin, end);
    along.insert(along.end(), more.begin(), more.end());
  };
  Point2 begin = from.point;
  for (const Bend& bend : bends) add(std::exchange(begin, bend.enters), bend.leaves);
  add(begin, to.point);
  return along;
}

bool Router::lies_on(const std::vector<HalfEdge>& seams, const Point3& place) const {
  return std::any_of(seams.begin(), seams.end(), [&](HalfEdge h) {
    const Triangle& t = sheet_.triangle(triangle_of(h));
    const Point3 begin = sheet_.position(t.deformed[to_size(corner_of(h))]);
    const Point3 way = sheet_.position(t.deformed[to_size(next_corner(corner_of(h)))]) + -1.0 * begin;
    const Point3 to = place + -1.0 * begin;
    const double share = std::clamp(dot(to, way) / dot(way, way), 0.0, 1.0);
    return length(to + -share * way) <= arrived * sheet_.mean_edge();
  });
}

bool Router::join(const PlaceAtRest& from, const PlaceAtRest& to, std::vector<Bend>& bends,
                  std::vector<HalfEdge>* along) const {
  if (from.triangle == to.triangle) return true;
  const std::vector<Step> steps = way(from, to);
  if (steps.empty()) return false;
  std::optional<std::vector<Bend>> found = straight(from, to, steps);
  if (!found) {
    // In one panel it is straight at rest, as in a sheet without seams, also over holes.
    const bool in_one =
        std::none_of(steps.begin(), steps.end(), [](const Step& step) { return step.seam.has_value(); });
    if (in_one && !meets_seam(from.point, to.point)) return true;
    const Strip strip = shortened(from, to, steps);
    found = shortest_way(strip);
    if (const std::vector<HalfEdge> seams = seams_along(from, to, *found); !seams.empty()) {
      if (along != nullptr) along->insert(along->end(), seams.begin(), seams.end());
      const bool is_asked_for = lies_on(seams, from.in_space) && lies_on(seams, to.in_space);
      if (sheet_.unrolled() || !is_asked_for) found = shortest_way(narrowed(strip));
    }
  }
  bends.insert(bends.end(), found->begin(), found->end());
  return true;
}

std::vector<Curve> Router::route(const std::vector<PlaceAtRest>& places, bool closed, const std::string& name,
                                 std::vector<HalfEdge>* along) const {
  std::vector<Curve> curves{{Curve::Kind::polyline, false, {places.front().point}}};
  const auto go_on = [&](Point2 p) {
    if (!has_seams() || curves.back().points.back() != p) curves.back().points.push_back(p);
  };
  const std::size_t ways = closed ? places.size() : places.size() - 1;
  for (std::size_t i = 0; i < ways; ++i) {
    const std::size_t next = (i + 1) % places.size();
    std::vector<Bend> bends;
    const std::string which = name + ", points " + std::to_string(i) + " and " + std::to_string(next);
    if (are_apart(places[i], places[next]))
      throw InputError(which +
                       ": nothing joins the parts they are on; give each a path of its own, or sew them (--sew)");
    const bool is_in_one = part_[places[i].triangle()] == part_[places[next].triangle()];
    if (has_seams() && is_in_one && !join(places[i], places[next], bends, along))
      throw InputError(which + ": no way over seams leads from one to the other");
    for (const Bend& bend : bends) {
      go_on(bend.leaves);
      if (bend.seam) curves.push_back({Curve::Kind::polyline, false, {bend.enters}});
    }
    if (next != 0) go_on(places[next].point);
  }
  if (curves.size() == 1) {
    curves.front().closed = closed;
  } else {
    if (closed) {  // the last one ends where the first one begins
      for (const Point2 p : curves.front().points) go_on(p);
      curves.erase(curves.begin());
    }
    // Of no length: where the way leads through a corner of a panel, or begins or ends on a seam.
    const double near = arrived * sheet_.mean_edge();
    std::erase_if(curves, [&](const Curve& curve) {
      return std::all_of(curve.points.begin(), curve.points.end(),
                         [&](Point2 p) { return within(p, curve.points.front(), near); });
    });
    for (std::size_t i = 0; i < curves.size(); ++i) {
      curves[i].continues = closed || i > 0;
      curves[i].goes_on = closed || i + 1 < curves.size();
    }
  }
  for (const Curve& curve : curves)
    for (std::size_t i = curve.closed ? 0 : 1; i < curve.points.size(); ++i) {
      const Point2 begin = i == 0 ? curve.points.back() : curve.points[i - 1];
      const std::vector<HalfEdge> seams = seams_along(begin, curve.points[i]);
      if (along != nullptr)
        along->insert(along->end(), seams.begin(), seams.end());
      else if (!seams.empty())
        throw InputError(name + ": runs along a seam, where a cut opens nothing; put the points a little beside it");
    }
  return curves;
}

}  // namespace cutbench
