#include "methods/element_deletion/element_deletion.h"

#include "harness/path/cut_failed.h"

namespace cutbench {

void ElementDeletion::embed(Sheet& sheet, Subdivision& trace, MethodNotes&) {
  crossed_.clear();
  for (const Subdivision::Face& face : trace.faces)
    if (face.segments >= 0) crossed_.push_back(face.triangle);
  if (crossed_.size() == sheet.triangle_count())
    throw CutRefused("the path crosses every triangle, and none would be left; refine the sheet");
  sheet.remove(crossed_);
  for (const Subdivision::Along& piece : trace.along)
    if (sheet.triangle(triangle_of(piece.edge)).alive()) sheet.set_mark(piece.edge, EdgeMark::path);
  trace.along.clear();
}

}  // namespace cutbench
