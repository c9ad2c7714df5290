#include "methods/delaunay_refine/delaunay_refine.h"

#include "harness/mesh/one_ring.h"

namespace cutbench {

void DelaunayRefine::improve(Sheet& sheet, MethodNotes& notes) {
  wedges_.find(sheet);
  refinement_.begin(sheet, wedges_);
  for_each_changed(sheet, [&](TriangleIndex t) { refinement_.flip_at(t); });
  notes.stopped_early = !refinement_.run(sheet);
}

}  // namespace cutbench
