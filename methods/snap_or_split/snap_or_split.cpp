#include "methods/snap_or_split/snap_or_split.h"

namespace cutbench {

void SnapOrSplit::adapt(Sheet& sheet, Subdivision& trace, const Polyline& asked) {
  snap_to_vertices(sheet, trace, asked, tolerance_, path_);
}

}  // namespace cutbench
