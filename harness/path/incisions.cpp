#include "harness/path/incisions.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

template <class Look>
void for_each_separating(const Sheet& sheet, Look look) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3 && sheet.triangle(TriangleIndex(t)).alive(); ++k)
      if (const HalfEdge h = half_edge(TriangleIndex(t), k); sheet.separates(h)) look(h);
}

/// The next half-edge of the same lip, or of what the lip runs into.
HalfEdge next_on_lip(const Sheet& sheet, HalfEdge h) {
  HalfEdge g = Sheet::next(h);
  while (!sheet.separates(g)) g = Sheet::next(sheet.opposite(g));
  return g;
}

/// h and g are pieces of one lip, and across them there is another one that doesn't turn off, either.
bool go_on(const Sheet& sheet, HalfEdge h, HalfEdge g) {
  const HalfEdge across_h = sheet.opposite(h), across_g = sheet.opposite(g);
  if (g == across_h) return false;  // round a tip
  if (!across_h.valid() || !across_g.valid()) return across_h.valid() == across_g.valid();
  return next_on_lip(sheet, across_g) == across_h;
}

struct OnCurve {
  double place;  ///< points of the polyline before it
  Point2 along;  ///< direction of the curve there
};

OnCurve nearest(const Polyline& line, Point2 a, Point2 b) {
  OnCurve found{0, {}};
  double least = std::numeric_limits<double>::infinity();
  const std::size_t pieces = line.points.size() - (line.closed ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Point2 p = line.points[i], q = line.points[(i + 1) % line.points.size()];
    const double away = squared_distance(a, p, q) + squared_distance(b, p, q);
    if (away >= least) continue;
    least = away;
    const double fraction = dot(0.5 * (a + b) - p, q - p) / squared_length(q - p);
    found = {to_double(i) + std::clamp(fraction, 0.0, 1.0), q - p};
  }
  return found;
}

}  // namespace

Incisions::Incisions(const Sheet& before) {
  for_each_separating(before, [&](HalfEdge h) {
    const Ends ends{before.origin(h), before.target(h)};
    open_[ends] = {before.rest(ends.first), before.rest(ends.second), -1};
  });
}

void Incisions::add(const Sheet& sheet, std::size_t cut) {
  std::map<Ends, Open> now;
  for_each_separating(sheet, [&](HalfEdge h) {
    const Ends ends{sheet.origin(h), sheet.target(h)};
    now[ends] = {sheet.rest(ends.first), sheet.rest(ends.second), to_index(cut)};
  });
  std::vector<Open> divided;  // that are there no longer, but in pieces; a border's pieces may be of two of them
  for (const auto& [ends, open] : open_) {
    const auto same = now.find(ends);
    if (same != now.end() && same->second.from == open.from && same->second.to == open.to)
      same->second.cut = open.cut;
    else
      divided.push_back(open);
  }
  const double near = meeting_tolerance * sheet.snap();
  const auto under = [&](Point2 p, Point2 along) {
    return std::find_if(divided.begin(), divided.end(), [&](const Open& older) {
      return dot(along, older.to - older.from) > 0 && squared_distance(p, older.from, older.to) <= near * near;
    });
  };
  for (auto& [ends, open] : now) {
    if (open.cut != to_index(cut)) continue;
    const Point2 along = open.to - open.from;
    const auto whole = under(0.5 * (open.from + open.to), along);
    if (whole != divided.end() && under(open.from, along) != divided.end() && under(open.to, along) != divided.end())
      open.cut = whole->cut;
  }
  open_ = std::move(now);
}

std::ptrdiff_t Incisions::cut_of(const Sheet& sheet, HalfEdge h) const {
  return open_.at({sheet.origin(h), sheet.target(h)}).cut;
}

std::vector<IncisionEdge> Incisions::edges(const Sheet& sheet, std::span<const Curve> cuts) const {
  std::vector<Polyline> lines(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i)
    flatten(cuts[i], default_flatten_tolerance * sheet.mean_edge(), sheet.snap(), lines[i]);
  std::vector<HalfEdge> opened;
  for_each_separating(sheet, [&](HalfEdge h) {
    if (cut_of(sheet, h) >= 0) opened.push_back(h);
  });
  // A method may open edges that run across its path, or back: the lip that they belong to knows where it goes.
  UnionFind lips(4 * sheet.triangle_slots());
  for (const HalfEdge h : opened) {
    const HalfEdge g = next_on_lip(sheet, h);
    if (go_on(sheet, h, g) && cut_of(sheet, h) == cut_of(sheet, g)) lips.join(h(), g());
  }
  std::map<std::size_t, double> forward;  // per lip: how far it goes along the path
  std::map<HalfEdge, double> place;
  for (const HalfEdge h : opened) {
    const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
    const OnCurve at = nearest(lines[to_size(cut_of(sheet, h))], a, b);
    forward[lips.find(h())] += dot(b - a, at.along) / length(at.along);
    place[h] = at.place;
  }
  std::vector<IncisionEdge> edges;
  for (const HalfEdge h : opened) {
    const HalfEdge other = sheet.opposite(h);
    const double balance = forward[lips.find(h())] - (other.valid() ? forward[lips.find(other())] : 0);
    const auto cut = to_size(cut_of(sheet, h));
    if (balance > 0 || (balance == 0 && (!other.valid() || h < other)))
      edges.push_back({cut, h, other});
    else if (!other.valid())
      edges.push_back({cut, {}, h});
  }
  std::sort(edges.begin(), edges.end(), [&](const IncisionEdge& a, const IncisionEdge& b) {
    const HalfEdge h = a.left.valid() ? a.left : a.right, g = b.left.valid() ? b.left : b.right;
    return std::tuple(a.cut, place.at(h), h) < std::tuple(b.cut, place.at(g), g);
  });
  return edges;
}

}  // namespace cutbench
