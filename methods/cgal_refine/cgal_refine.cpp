#include "methods/cgal_refine/cgal_refine.h"

#include <algorithm>
#include <cmath>

namespace cutbench {

void CgalRefine::embed(Sheet& sheet, Subdivision& trace) { recovered_ = embed_plainly(sheet, trace, work_); }

void CgalRefine::improve(Sheet& sheet) {
  wedges_.find(sheet);
  find_changed(sheet, region_);
  stopped_early_ = false;
  if (region_.empty()) return;

  const bool refining = std::isfinite(options_.bound);
  const std::size_t most_vertices =
      std::min(options_.per_path_vertex * sheet.log().path_vertices.size(), options_.most_vertices);
  const RegionMesher::Limits limits{.max_aspect = options_.bound,
                                    .min_edge = options_.min_edge * sheet.mean_edge(),
                                    .most_vertices = refining ? most_vertices : 0,
                                    .wedges = &wedges_};
  grow_region(sheet, options_.rings, region_);
  for (int rings = 1; rings <= options_.most_rings; rings *= 2) {
    mesher_.convert(sheet, region_, true);
    if (!mesher_.insert(sheet)) break;
    const bool complete = mesher_.refine(sheet, limits) || !refining;
    if (mesher_.divided().empty()) {
      stopped_early_ = !mesher_.put_back(sheet) || !complete;
      return;
    }
    across_.clear();  // the region grows where it was too small, each time by more
    for (const HalfEdge h : mesher_.divided())
      for (const HalfEdge side : {h, sheet.opposite(h)}) across_.push_back(triangle_of(side));
    grow_region(sheet, rings, across_);
    region_.insert(region_.end(), across_.begin(), across_.end());
    grow_region(sheet, 0, region_);
  }
  stopped_early_ = true;
}

}  // namespace cutbench
