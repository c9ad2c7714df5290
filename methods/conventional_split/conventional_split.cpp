#include "methods/conventional_split/conventional_split.h"

#include "harness/cut/embed_conventionally.h"

namespace cutbench {

void ConventionalSplit::embed(Sheet& sheet, Subdivision& trace) {
  recovered_ = embed_conventionally(sheet, trace, work_);
}

}  // namespace cutbench
