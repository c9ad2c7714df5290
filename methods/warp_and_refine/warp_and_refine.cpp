#include "methods/warp_and_refine/warp_and_refine.h"

namespace cutbench {

void WarpAndRefine::embed(Sheet& sheet, Subdivision& trace) {
  curve_.read(trace);
  if (options_.warp) warp_.run(sheet, trace);
  recovered_ = embed_plainly(sheet, trace, work_);
  curve_.find_vertices(sheet, trace);
}

void WarpAndRefine::improve(Sheet& sheet) {
  reshape_.begin(sheet, curve_);
  if (options_.thin) reshape_.thin();
  if (options_.flip || options_.smooth) reshape_.mend(options_.smooth);
}

}  // namespace cutbench
