#include "methods/split_and_tie/split_and_tie.h"

#include "methods/tools/static_split.h"
#include "methods/tools/tie_slivers.h"

namespace cutbench {

void SplitAndTie::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Ties SplitAndTie::ties(const Sheet& before, const Sheet& cut) const {
  return tie_slivers(before, cut, options_.thinness, true);
}

}  // namespace cutbench
