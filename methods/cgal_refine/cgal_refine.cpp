#include "methods/cgal_refine/cgal_refine.h"

#include <algorithm>
#include <cmath>

namespace cutbench {

void CgalRefine::improve(Sheet& sheet, MethodNotes& notes) {
  wedges_.find(sheet);
  region_.clear(sheet);
  region_.add_changed(sheet);
  if (region_.triangles().empty()) return;

  const bool refining = std::isfinite(options_.bound);
  const std::size_t most_vertices =
      std::min(options_.per_path_vertex * sheet.log().path_vertices.size(), options_.most_vertices);
  const RegionMesher::Limits limits{.max_aspect = options_.bound,
                                    .min_edge = options_.min_edge * sheet.mean_edge(),
                                    .most_vertices = refining ? most_vertices : 0,
                                    .wedges = &wedges_};
  region_.grow(sheet, options_.rings);
  for (int rings = 2;; rings *= 4) {
    mesher_.convert(sheet, region_, true);
    if (!mesher_.insert(sheet)) break;
    const bool complete = mesher_.refine(sheet, limits) || !refining;
    if (mesher_.divided().empty()) {
      notes.improved_nothing = !mesher_.put_back(sheet);
      notes.stopped_early = notes.improved_nothing || !complete;
      return;
    }
    if (!complete || rings > options_.most_rings) break;
    across_.clear(sheet);  // the region grows where it was too small, each time by more
    for (const HalfEdge h : mesher_.divided())
      for (const HalfEdge side : {h, sheet.opposite(h)}) across_.add(triangle_of(side));
    across_.grow(sheet, rings);
    for (const TriangleIndex t : across_.triangles()) region_.add(t);
    region_.grow(sheet, 0);
  }
  notes.stopped_early = notes.improved_nothing = true;
}

}  // namespace cutbench
