#include "methods/conventional_split/conventional_split.h"

#include "methods/tools/static_split.h"

namespace cutbench {

void ConventionalSplit::embed(Sheet& sheet, Subdivision& trace) {
  recovered_ = embed_by_static_split(sheet, trace, work_);
}

}  // namespace cutbench
