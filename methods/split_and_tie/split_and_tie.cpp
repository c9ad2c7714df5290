#include "methods/split_and_tie/split_and_tie.h"

#include "harness/cut/embed_conventionally.h"
#include "harness/cut/tie_slivers.h"

namespace cutbench {

void SplitAndTie::embed(Sheet& sheet, Subdivision& trace) { recovered_ = embed_conventionally(sheet, trace, work_); }

Ties SplitAndTie::ties(const Sheet& before, const Sheet& cut) const {
  return tie_slivers(before, cut, options_.thinness);
}

}  // namespace cutbench
