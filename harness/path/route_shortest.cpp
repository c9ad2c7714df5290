// The shortest way through triangles that are laid flat beside each other, and past the points that it bends at.

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/path/route.h"

namespace cutbench {

/// Where a step leads through its edges: shares of both at its right and at its left end, as a triangle that is
/// counter-clockwise is left.
Router::Gate Router::gate(const Step& step) const {
  if (!step.seam) return {{0, 1}, {1, 0}};
  const SewnEdge &out = edges_[to_size(first_edge_[step.out()])], &in = edges_[to_size(first_edge_[step.in()])];
  std::array<double, 2> ends{std::max(out.low(), in.low()), std::min(out.high(), in.high())};
  if (out.end < out.begin) std::swap(ends[0], ends[1]);
  Gate gate;
  for (std::size_t k = 0; k < 2; ++k) {
    gate.out[k] = std::clamp((ends[k] - out.begin) / (out.end - out.begin), 0.0, 1.0);
    gate.in[k] = std::clamp((ends[k] - in.begin) / (in.end - in.begin), 0.0, 1.0);
  }
  return gate;
}

/// The triangles along `way` laid flat beside each other, in the plane of the first one. \pre `way` is not empty
Router::Strip Router::laid_flat(const PlaceAtRest& from, const PlaceAtRest& to, std::vector<Step> way) const {
  Strip strip{std::move(way), {}, from.point, {}};
  Laying laying;
  std::vector<Point2> last{from.point};
  const auto same = [&](Point2 p) {  // as before, where another chart's rounding is all the difference
    for (const Point2 q : last)
      if (length(p - q) <= arrived * sheet_.mean_edge()) return q;
    return p;
  };
  for (const Step& step : strip.way) {
    const Gate through = gate(step);
    const auto back = [&laying](Point2 p) {  // the transposed matrix is the inverse one
      const Point2 d = p - laying.shift;
      return Point2{dot(laying.x, d), dot(laying.y, d)};
    };
    Portal portal{step, through, {}, cross(laying.x, laying.y) < 0};
    for (std::size_t k = 0; k < 2; ++k)
      portal.ends[portal.turned_over ? 1 - k : k] = same(back(at_share(step.out, through.out[k])));
    last = {portal.ends[0], portal.ends[1]};
    strip.portals.push_back(portal);
    if (step.seam) laying = across(step).after(laying);
  }
  const Point2 d = to.point - laying.shift;
  strip.goal = same({dot(laying.x, d), dot(laying.y, d)});
  return strip;
}

/// The shortest way within a strip, by its bends: ends of portals (Lee and Preparata 1984; in Mononen's form, 2010).
std::vector<Router::Corner> Router::shortest(const Strip& strip) const {
  std::vector<Corner> corners;
  const std::size_t count = strip.portals.size();
  Point2 apex = strip.begin;
  std::array<Point2, 2> end{apex, apex};
  std::array<std::size_t, 2> at{0, 0};
  for (std::size_t i = 0; i <= count; ++i) {
    for (const std::size_t side : {0, 1}) {  // right, left
      const Point2 next = i < count ? strip.portals[i].ends[side] : strip.goal;
      const double sign = side == 0 ? 1 : -1;
      if (sign * cross(end[side] - apex, next - apex) < 0) continue;  // wider than before
      const std::size_t other = 1 - side;
      const bool is_open = apex == end[side] || apex == end[other] || next == end[other];
      if (is_open || sign * cross(end[other] - apex, next - apex) < 0) {
        end[side] = next;
        at[side] = i;
        continue;
      }
      apex = end[other];
      const std::size_t portal = at[other];
      corners.push_back({portal, other, apex});
      end = {apex, apex};
      at = {portal, portal};
      i = portal;
      break;
    }
  }
  return corners;
}

double Router::length_of(const Strip& strip, const std::vector<Corner>& corners) {
  double sum = 0;
  Point2 last = strip.begin;
  for (const Corner& corner : corners) sum += length(corner.point - std::exchange(last, corner.point));
  return sum + length(strip.goal - last);
}

/// `way` led past the other side of a point that it bends at; none where the sheet ends there.
std::optional<std::vector<Router::Step>> Router::past(const Strip& strip, const Corner& corner) const {
  const double near = arrived * sheet_.mean_edge();
  const auto is_there = [&](std::size_t i) {
    return length(strip.portals[i].ends[corner.side] - corner.point) <= near;
  };
  std::size_t first = corner.portal, last = corner.portal;
  while (first > 0 && is_there(first - 1)) --first;
  while (last + 1 < strip.portals.size() && is_there(last + 1)) ++last;
  const Portal& portal = strip.portals[first];
  // Round the point the other way, which in each triangle is at the other end of the gate.
  std::size_t own = portal.turned_over ? 1 - corner.side : corner.side;
  Point2 point = at_share(portal.step.out, portal.gate.out[own]);
  TriangleIndex t = triangle_of(portal.step.out);
  const TriangleIndex goal = triangle_of(strip.portals[last].step.in);
  std::vector<Step> round(strip.way.begin(), strip.way.begin() + to_index(first));
  for (std::size_t steps = 0; t != goal; ++steps) {
    if (steps > sheet_.triangle_slots()) return {};
    std::optional<Step> next;
    Gate through;
    for (const Step& step : steps_out_of(t)) {
      const Gate g = gate(step);
      if (length(at_share(step.out, g.out[1 - own]) - point) > near) continue;
      next = step;
      through = g;
    }
    if (!next) return {};
    round.push_back(*next);
    point = at_share(next->in, through.in[1 - own]);
    if (next->seam) {
      const Laying laying = across(*next);
      if (cross(laying.x, laying.y) < 0) own = 1 - own;
    }
    t = triangle_of(next->in);
  }
  round.insert(round.end(), strip.way.begin() + to_index(last) + 1, strip.way.end());
  return round;
}

/// The way made as short as it can be made without a jump: past each point at which it bends and that it is shorter to
/// pass on the other side (Xin and Wang 2007; Sharp and Crane 2020). What bends are left are at the border, at the tips
/// of incisions, and at vertices with more than 360 degrees round them.
Router::Strip Router::shortened(const PlaceAtRest& from, const PlaceAtRest& to, const std::vector<Step>& way) const {
  constexpr double shorter = 1 - 1e-12;
  Strip strip = laid_flat(from, to, way);
  std::vector<Corner> corners = shortest(strip);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto other_way = past(strip, corners[i]);
    if (!other_way) continue;
    Strip other = laid_flat(from, to, *other_way);
    std::vector<Corner> its_corners = shortest(other);
    if (length_of(other, its_corners) >= shorter * length_of(strip, corners)) continue;
    strip = std::move(other);
    corners = std::move(its_corners);
    i = to_size(-1);  // from the first one again
  }
  return strip;
}

/// With a tenth of each gate closed at both ends, but for gates that end where the way itself begins or ends.
///
/// A shortest way bends at vertices that have more than 360 degrees round them, and runs along the edges between these,
/// which may be seams; in the narrowed strip it goes past them.
Router::Strip Router::narrowed(Strip strip) const {
  constexpr double closed = 0.1;
  const double near = arrived * sheet_.mean_edge();
  for (Portal& portal : strip.portals) {
    const Portal open = portal;
    for (const std::size_t k : {0, 1}) {  // right, left
      const Point2 end = open.ends[k];
      if (length(end - strip.begin) <= near || length(end - strip.goal) <= near) continue;
      portal.ends[k] = end + closed * (open.ends[1 - k] - end);
      const std::size_t own = portal.turned_over ? 1 - k : k;
      portal.gate.out[own] += closed * (open.gate.out[1 - own] - open.gate.out[own]);
      portal.gate.in[own] += closed * (open.gate.in[1 - own] - open.gate.in[own]);
    }
  }
  return strip;
}

std::vector<Router::Bend> Router::shortest_way(const Strip& strip) const {
  const std::vector<Corner> corners = shortest(strip);
  std::vector<Bend> bends;
  auto corner = corners.begin();
  Point2 begin = strip.begin;
  for (std::size_t i = 0; i < strip.portals.size(); ++i) {
    const Portal& portal = strip.portals[i];
    const Point2 end = corner != corners.end() ? corner->point : strip.goal;
    const Point2 right = portal.ends[0], left = portal.ends[1];
    const double r = cross(end - begin, right - begin), l = cross(end - begin, left - begin);
    double share = r == l ? 0 : std::clamp(r / (r - l), 0.0, 1.0);  // from right to left
    const bool bends_here = corner != corners.end() && corner->portal == i;
    if (bends_here) share = to_double(corner->side);
    if (portal.turned_over) share = 1 - share;
    const auto at = [share](const std::array<double, 2>& ends) { return ends[0] + share * (ends[1] - ends[0]); };
    const Point2 leaves = at_share(portal.step.out, at(portal.gate.out));
    const Point2 enters = at_share(portal.step.in, at(portal.gate.in));
    if (portal.step.seam || bends_here) bends.push_back({leaves, enters, portal.step.seam.has_value()});
    while (corner != corners.end() && corner->portal == i) begin = (corner++)->point;
  }
  return bends;
}

}  // namespace cutbench
