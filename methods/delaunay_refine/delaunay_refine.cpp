#include "methods/delaunay_refine/delaunay_refine.h"

#include "harness/mesh/star.h"

namespace cutbench {

void DelaunayRefine::embed(Sheet& sheet, Subdivision& trace) {
  recovered_ = embed_by_delaunay_split(sheet, trace, work_);
}

void DelaunayRefine::improve(Sheet& sheet) {
  wedges_.find(sheet);
  refinement_.begin(sheet, wedges_);
  for_each_changed(sheet, [&](TriangleIndex t) { refinement_.flip_at(t); });
  stopped_early_ = !refinement_.run(sheet);
}

}  // namespace cutbench
