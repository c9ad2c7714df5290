#include "methods/tools/static_split.h"

namespace cutbench {

int split_conventionally(Patch& patch) {
  const std::size_t on_edges = patch.ring.size() - 3, inside = patch.inside_count();
  if (on_edges != 1 || inside > 1 || (inside == 1 && patch.segments.size() != 1)) return split_step_by_step(patch);
  const int p = 3, tip = 4;
  const int a = patch.edge_of(p), b = next_corner(a), c = previous_corner(a);  // p lies between a and b
  if (inside == 0)
    patch.triangles = {{a, p, c}, {p, b, c}};
  else
    patch.triangles = {{a, p, tip}, {p, b, tip}, {b, c, tip}, {c, a, tip}};
  return 0;
}

int embed_by_static_split(Sheet& sheet, Subdivision& trace, PatchWork& work) {
  int recovered = 0;
  embed_patches(
      sheet, trace, work, [](const Crossing& crossing) { return crossing.p_first; },
      [&](Patch& patch) { recovered += split_conventionally(patch); });
  return recovered;
}

}  // namespace cutbench
