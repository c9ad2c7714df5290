#include "methods/split_and_tie/split_and_tie.h"

#include "methods/tools/static_split.h"
#include "methods/tools/tie_slivers.h"

namespace cutbench {

void SplitAndTie::embed(Sheet& sheet, Subdivision& trace) { recovered_ = embed_by_static_split(sheet, trace, work_); }

Ties SplitAndTie::ties(const Sheet& before, const Sheet& cut) const {
  return tie_slivers(before, cut, options_.thinness);
}

}  // namespace cutbench
