#include "methods/cut_polygons/cut_polygons.h"

#include "methods/tools/static_split.h"

namespace cutbench {

void CutPolygons::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

std::vector<Polygon> CutPolygons::stabilised(std::vector<Polygon> polygons) const {
  for (Polygon& polygon : polygons) polygon.stabilisation = options_.stabilisation;
  return polygons;
}

Constraints CutPolygons::constraints(const Sheet& before, const Sheet& cut) const {
  return {.polygons = stabilised(merge_thin_parts(before, cut, options_.thin))};
}

Constraints CutPolygons::next_constraints(const Sheet& before, const Sheet& cut, const Constraints& /*last*/,
                                          const PolygonsLeft& left) const {
  return {.polygons = stabilised(merge_new_thin_parts(before, cut, options_.thin, left))};
}

}  // namespace cutbench
