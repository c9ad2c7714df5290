#include "methods/vertex_snap/vertex_snap.h"

#include <algorithm>
#include <cmath>

#include "harness/mesh/one_ring.h"

namespace cutbench {

namespace {

Point2 nearest_on_segment(Point2 a, Point2 b, Point2 p) {
  const double length2 = squared_length(b - a);
  return length2 > 0 ? a + std::clamp(dot(p - a, b - a) / length2, 0.0, 1.0) * (b - a) : a;
}

}  // namespace

/// Where the vertex of run_ goes; nothing where it must stay.
std::optional<Point2> VertexSnap::target(const Sheet& sheet) const {
  const VertexIndex v = run_.vertex;
  if (sheet.on_border(sheet.first_outgoing(v))) {
    if (!is_straight_at(sheet, v)) return {};
    for (const int n : run_.nodes)
      if (sheet.on_border(path_.place(n).edge)) return path_.point(n);
    return {};
  }
  std::optional<Point2> best;
  const auto consider = [&](int from, int to) {
    if (from < 0 || to < 0) return;
    const Point2 p = nearest_on_segment(path_.point(from), path_.point(to), sheet.rest(v));
    if (!best || squared_length(p - sheet.rest(v)) < squared_length(*best - sheet.rest(v))) best = p;
  };
  for (const int n : run_.nodes)
    if (sheet.mark(path_.place(n).edge) != EdgeMark::none) return {};  // an older incision ends or passes at v
  consider(run_.before, run_.nodes.front());
  for (std::size_t i = 0; i + 1 < run_.nodes.size(); ++i) consider(run_.nodes[i], run_.nodes[i + 1]);
  consider(run_.nodes.back(), run_.after);
  return best;
}

/// What the run to a tip leaves out lies as near to the new way as the vertex's reach.
bool VertexSnap::stays_near(const Sheet& sheet, int tip) const {
  double longest = 0;
  for (const HalfEdge h : outgoing_edges(sheet, run_.vertex)) {
    longest = std::max(longest, squared_length(sheet.rest(sheet.target(h)) - sheet.rest(run_.vertex)));
  }
  const double reach = options_.reach * options_.reach * longest;
  const Point2 to = path_.point(tip), from = path_.point(run_.before);
  return std::all_of(run_.nodes.begin(), run_.nodes.end(), [&](int n) {
    const Point2 p = path_.point(n);
    return squared_length(p - nearest_on_segment(from, to, p)) <= reach;
  });
}

void VertexSnap::adapt(Sheet& sheet, Subdivision& trace, const Polyline&) {
  path_.read(sheet, trace);
  const auto near = path_.approaches(options_.reach), tips = path_.tips(options_.reach, Polyline());  // they stay
  const auto move_to = [&](Point2 to) {
    if (worst_aspect(sheet, run_.vertex, to) <= options_.max_aspect && sheet.move(run_.vertex, to))
      path_.contract(run_);
  };
  for (const auto& tip : tips)
    if (path_.find_tip_run(tip.node, tip.vertex, 1, run_) && path_.has_star_to_itself(run_) &&
        stays_near(sheet, tip.node))
      move_to(path_.point(tip.node));
  for (const auto& crossing : near) {
    if (!path_.find_run(crossing.node, crossing.vertex, 1, run_) || !path_.has_star_to_itself(run_)) continue;
    if (const auto to = target(sheet)) move_to(*to);
  }
  if (!near.empty() || !tips.empty()) path_.write(trace);
}

}  // namespace cutbench
