#include "methods/warp_and_refine/warp_and_refine.h"

#include "methods/tools/constrain_slivers.h"

namespace cutbench {

void WarpAndRefine::adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) {
  curve_.read(sheet, trace, path);
  if (options_.before == Before::snap) snap_to_vertices(sheet, trace, path, options_.snap, path_);
  if (options_.before == Before::warp || options_.before == Before::warp_and_thin) warp_.run(sheet, trace, curve_);
}

void WarpAndRefine::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  curve_.find_vertices(sheet, trace);
}

void WarpAndRefine::improve(Sheet& sheet, MethodNotes& notes) {
  reshape_.begin(sheet, curve_);
  if (options_.before == Before::thin || options_.before == Before::warp_and_thin) reshape_.thin();
  if (options_.after >= After::flips && options_.after <= After::refine)
    reshape_.flip_and_smooth(options_.after >= After::smoothing);
  if (options_.after == After::refine) notes.stopped_early = !reshape_.refine();
}

Constraints WarpAndRefine::constraints(const Sheet& before, const Sheet& cut) const {
  return constrain_slivers(before, cut, options_.thinness, false);
}

}  // namespace cutbench
