#include "methods/delaunay_refine/delaunay_refine.h"

#include <algorithm>

#include "harness/mesh/star.h"

namespace cutbench {

void DelaunayRefine::embed(Sheet& sheet, Subdivision& trace) { recovered_ = embed_plainly(sheet, trace, work_); }

void DelaunayRefine::improve(Sheet& sheet) {
  wedges_.find(sheet);
  refinement_.begin(sheet, wedges_);
  for_each_changed(sheet, [&](TriangleIndex t) { refinement_.flip_at(t); });
  const std::size_t path_vertices = sheet.log().path_vertices.size();
  stopped_early_ = !refinement_.run(sheet, std::min(options_.per_path_vertex * path_vertices, options_.most_vertices));
}

}  // namespace cutbench
