#include "methods/snap_or_split/snap_or_split.h"

namespace cutbench {

void SnapOrSplit::embed(Sheet& sheet, Subdivision& trace) {
  path_.read(sheet, trace);
  const auto near = path_.approaches(tolerance_);
  for (const auto& crossing : near)
    if (path_.find_run(crossing.node, crossing.vertex, tolerance_, run_)) path_.contract(run_);
  if (!near.empty()) path_.write(trace);
  recovered_ = embed_plainly(sheet, trace, work_);
}

}  // namespace cutbench
