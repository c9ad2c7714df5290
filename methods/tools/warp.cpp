#include "methods/tools/warp.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/quality.h"

namespace cutbench {

/// What the run stands for; first is -1 where that is not one piece of the trace's nodes, as where a loop closes.
Warp::Share Warp::share_of_run() const {
  Share all = share(run_.nodes.front());
  int count = 0;
  for (const int n : run_.nodes) {
    all.first = std::min(all.first, share(n).first);
    all.last = std::max(all.last, share(n).last);
    count += share(n).last - share(n).first + 1;
  }
  if (all.last - all.first + 1 != count) all.first = -1;
  return all;
}

/// Whether what the new path by the target leaves out lies close to it.
bool Warp::stays_near(int target, const PathCurve& curve) const {
  const Point2 to = path_.point(target);
  for (const int n : run_.nodes) {
    const Point2 p = path_.point(n);
    double nearest = squared_length(p - to);
    for (const int end : {run_.before, run_.after})
      if (end >= 0) nearest = std::min(nearest, squared_distance(p, to, path_.point(end)));
    if (nearest > tolerance_ * tolerance_) return false;
  }
  const Share run = share_of_run();
  for (const int end : {run_.before, run_.after}) {
    if (end < 0) continue;
    const bool joined = run.first >= 0 && (share(end).last + 1 == run.first || run.last + 1 == share(end).first);
    if (joined ? !curve.stays_near_between_nodes(share(end).at, share(target).at, path_.point(end), to, tolerance_)
               : curve.is_simplified())
      return false;
  }
  return true;
}

/// Moves the run's vertex to one of its nodes, which is returned; -1 where it stays.
int Warp::move_to_path(Sheet& sheet, const PathCurve& curve) {
  const VertexIndex v = run_.vertex;
  const bool on_border = sheet.on_border(sheet.first_outgoing(v));
  if (on_border ? !is_straight_at(sheet, v) : options_.border_only) return -1;
  targets_.clear();
  for (const int n : run_.nodes) {
    if (sheet.mark(path_.place(n).edge) != EdgeMark::none) return -1;  // an older incision ends or passes at v
    if (on_border == sheet.on_border(path_.place(n).edge)) targets_.push_back(n);
  }
  const Point2 from = sheet.rest(v);
  const auto key = [&](int n) { return std::pair(squared_length(path_.point(n) - from), n); };
  std::sort(targets_.begin(), targets_.end(), [&](int a, int b) { return key(a) < key(b); });
  for (const int target : targets_) {
    const Point2 to = path_.point(target);
    if (stays_near(target, curve) && worst_aspect(sheet, v, to) <= options_.max_aspect && sheet.move(v, to))
      return target;
  }
  return -1;
}

void Warp::run(Sheet& sheet, Subdivision& trace, const PathCurve& curve) {
  // A vertex may have thousands of outgoing edges, and the cost grows with the cube of the run's nodes.
  constexpr std::size_t most_nodes = 64;
  tolerance_ = std::min(options_.tolerance * sheet.mean_edge(), trace.chord_tolerance);
  path_.read(sheet, trace);
  shares_.clear();
  for (int n = 0; n < path_.size(); ++n) shares_.push_back({n, n, n});
  bool moved = false;
  for (const auto& crossing : path_.approaches(options_.reach)) {
    if (!path_.find_run(crossing.node, crossing.vertex, 1, run_)) continue;
    if (run_.nodes.size() > most_nodes || !path_.has_star_to_itself(run_)) continue;
    const int target = move_to_path(sheet, curve);
    if (target < 0) continue;
    Share all = share_of_run();
    if (all.first < 0) all = {-2, -2, share(target).at};  // next to no other node
    all.at = share(target).at;
    shares_[to_size(run_.nodes.front())] = all;
    path_.contract(run_);
    moved = true;
  }
  if (moved) path_.write(trace);
}

}  // namespace cutbench
