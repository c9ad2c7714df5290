#include "harness/cut/delaunay_split.h"

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

int embed_by_delaunay_split(Sheet& sheet, Subdivision& trace, PatchWork& work) {
  int recovered = 0;
  embed_patches(sheet, trace, work, is_diagonal_from_p_delaunay,
                [&](Patch& patch) { recovered += split_step_by_step(patch); });
  return recovered;
}

bool is_diagonal_from_p_delaunay(const Crossing& crossing) {
  const auto &q = crossing.q, &c = crossing.c, &a = crossing.a, &p = crossing.p;
  return crossing.p_first ? in_circle(p.point, c.point, a.point, q.point) <= 0
                          : in_circle(q.point, c.point, a.point, p.point) > 0;
}

int split_step_by_step(Patch& patch) {
  const auto inside = [&](int p) { return patch.ring_position[to_size(p)] < 0; };
  start_triangulation(patch);
  for (int p : patch.path_order)
    if (inside(p)) insert_inside(patch, p);
  for (int p : patch.path_order)
    if (!inside(p)) insert_on_ring(patch, p);
  return recover_segments(patch);
}

}  // namespace cutbench
