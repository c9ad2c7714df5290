#include "methods/snap_or_split/snap_or_split.h"

namespace cutbench {

void SnapOrSplit::adapt(Sheet& sheet, Subdivision& trace, const Polyline&) {
  snap_to_vertices(sheet, trace, tolerance_, path_);
}

}  // namespace cutbench
