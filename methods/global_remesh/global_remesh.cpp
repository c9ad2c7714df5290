#include "methods/global_remesh/global_remesh.h"

namespace cutbench {

void GlobalRemesh::improve(Sheet& sheet, MethodNotes& notes) {
  // With triangles whose longest edge is at most this, their number comes out near that of the sheet.
  constexpr double longest_edge = 1.5;
  wedges_.find(sheet);
  sheet_.clear(sheet);
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) sheet_.add(TriangleIndex(t));
  mesher_.convert(sheet, sheet_, false);
  const double h = sheet.mean_edge();
  const bool complete =
      mesher_.insert(sheet) && mesher_.refine(sheet, {.max_aspect = 3,
                                                      .max_edge = longest_edge * h,
                                                      .min_edge = 1e-3 * h,
                                                      .most_vertices = 4 * sheet_.triangles().size() + 1000,
                                                      .wedges = &wedges_});
  notes.stopped_early = notes.improved_nothing = !complete || !mesher_.put_back(sheet);
}

}  // namespace cutbench
