#include "methods/split_and_tie/split_and_tie.h"

#include "methods/tools/constrain_slivers.h"
#include "methods/tools/static_split.h"

namespace cutbench {

void SplitAndTie::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Constraints SplitAndTie::constraints(const Sheet& before, const Sheet& cut) const {
  return constrain_slivers(before, cut, options_.thinness, true);
}

Constraints SplitAndTie::next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                                          const PolygonsLeft& /*left*/) const {
  return constrain_new_slivers(before, cut, options_.thinness, last);
}

}  // namespace cutbench
