#include "methods/snap_or_split/snap_or_split.h"

namespace cutbench {

void SnapOrSplit::embed(Sheet& sheet, Subdivision& trace) {
  snap_to_vertices(sheet, trace, tolerance_, path_);
  recovered_ = embed_by_delaunay_split(sheet, trace, work_);
}

}  // namespace cutbench
