#include "methods/example/example.h"

namespace cutbench {

namespace {

bool is_diagonal_from_p_shorter(const Crossing& crossing) {
  const double from_p = squared_length(crossing.c.point - crossing.p.point);
  const double from_q = squared_length(crossing.a.point - crossing.q.point);
  return from_p < from_q || (from_p == from_q && crossing.p_first);
}

}  // namespace

void Example::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  embed_patches(sheet, trace, patch_work_, is_diagonal_from_p_shorter,
                [&](Patch& patch) { notes.recovered_segments += split_step_by_step(patch); });
}

}  // namespace cutbench
