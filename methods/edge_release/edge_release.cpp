#include "methods/edge_release/edge_release.h"

namespace cutbench {

void EdgeRelease::adapt(Sheet& sheet, Subdivision& trace, const Polyline& asked) {
  path_.read(sheet, trace);
  for (int n = 0; n < path_.size(); ++n) path_.straighten(n);
  const auto crossings = path_.approaches(0.5), tips = path_.tips(1, asked);
  const auto release = [&](int node, VertexIndex v) {
    if (path_.find_run(node, v, 1, run_)) path_.contract(run_);
  };
  for (const auto& crossing : crossings) release(crossing.node, crossing.vertex);
  for (const auto& crossing : crossings) {
    const Place& left_over = path_.place(crossing.node);
    if (left_over.kind != Place::Kind::edge) continue;
    const VertexIndex a = sheet.origin(left_over.edge), b = sheet.target(left_over.edge);
    release(crossing.node, crossing.vertex == a ? b : a);
  }
  for (const auto& tip : tips)
    if (path_.find_tip_run(tip.node, tip.vertex, 1, run_))
      path_.contract(run_);
    else
      path_.retract(tip.node, tip.vertex);
  path_.write(trace);
}

}  // namespace cutbench
