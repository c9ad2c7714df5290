#include "harness/cut/cutting_method.h"

#include "harness/cut/delaunay_split.h"

namespace cutbench {

void CuttingMethod::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_delaunay_split(sheet, trace, patch_work_);
}

}  // namespace cutbench
