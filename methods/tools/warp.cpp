#include "methods/tools/warp.h"

#include <algorithm>
#include <cmath>

#include "harness/mesh/quality.h"
#include "harness/mesh/star.h"

namespace cutbench {

/// Points of the path that the run leaves out lie close to the new way by `to`.
bool Warp::stays_near(Point2 to) const {
  const double most = tolerance_ * tolerance_;
  for (const int n : run_.nodes) {
    const Point2 p = path_.point(n);
    double nearest = squared_length(p - to);
    for (const int end : {run_.before, run_.after})
      if (end >= 0) nearest = std::min(nearest, squared_distance(p, to, path_.point(end)));
    if (nearest > most) return false;
  }
  return true;
}

bool Warp::move_to_path(Sheet& sheet) {
  const VertexIndex v = run_.vertex;
  const bool on_border = sheet.on_border(sheet.first_outgoing(v));
  if (on_border && !is_straight_at(sheet, v)) return false;
  targets_.clear();
  for (const int n : run_.nodes) {
    if (sheet.mark(path_.place(n).edge) != EdgeMark::none) return false;  // an older incision ends or passes at v
    if (on_border == sheet.on_border(path_.place(n).edge)) targets_.push_back(path_.point(n));
  }
  const Point2 from = sheet.rest(v);
  std::sort(targets_.begin(), targets_.end(),
            [&](Point2 a, Point2 b) { return squared_length(a - from) < squared_length(b - from); });
  for (const Point2 to : targets_)
    if (stays_near(to) && worst_aspect(sheet, v, to) <= options_.max_aspect && sheet.move(v, to)) return true;
  return false;
}

void Warp::run(Sheet& sheet, Subdivision& trace) {
  constexpr std::size_t most_nodes =
      64;  // where a vertex has thousands of outgoing edges, the cube of that would take minutes
  tolerance_ = std::min(options_.tolerance * sheet.mean_edge(), trace.chord_tolerance);
  path_.read(sheet, trace);
  bool moved = false;
  for (const auto& crossing : path_.approaches(options_.reach)) {
    if (!path_.find_run(crossing.node, crossing.vertex, 1, run_)) continue;
    if (run_.nodes.size() > most_nodes || !path_.has_star_to_itself(run_)) continue;
    if (!move_to_path(sheet)) continue;
    path_.contract(run_);
    moved = true;
  }
  if (moved) path_.write(trace);
}

}  // namespace cutbench
