#include "methods/cut_polygons/cut_polygons.h"

#include "methods/tools/static_split.h"
#include "methods/tools/thin_parts.h"

namespace cutbench {

void CutPolygons::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Constraints CutPolygons::constraints(const Sheet& before, const Sheet& cut) const {
  return {.polygons = merge_thin_parts(before, cut, options_.thinness)};
}

Constraints CutPolygons::next_constraints(const Sheet& before, const Sheet& cut, const Constraints& /*last*/,
                                          const PolygonsLeft& left) const {
  return {.polygons = merge_new_thin_parts(before, cut, options_.thinness, left)};
}

}  // namespace cutbench
