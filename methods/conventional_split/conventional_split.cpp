#include "methods/conventional_split/conventional_split.h"

#include "methods/tools/static_split.h"

namespace cutbench {

void ConventionalSplit::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

}  // namespace cutbench
