#include "methods/global_remesh/global_remesh.h"

#include "harness/mesh/one_ring.h"
#include "harness/mesh/quality.h"

namespace cutbench {

void GlobalRemesh::adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) {
  if (!simplifies_) return;
  curve_.read(sheet, trace, path);
  warp_.run(sheet, trace, curve_);
}

void GlobalRemesh::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  if (simplifies_) curve_.find_vertices(sheet, trace);
}

namespace {

/// The shape of the triangles if the origin of h went to its target: they stay where the mesh generator fails.
bool is_sound_after_collapse(const Sheet& sheet, HalfEdge h) {
  constexpr double thinnest = 1e5;
  const VertexIndex b = sheet.target(h);
  bool sound = true;
  for_each_outgoing(sheet, sheet.origin(h), [&](HalfEdge out) {
    const VertexIndex c = sheet.target(out), d = sheet.origin(Sheet::previous(out));
    if (c != b && d != b) sound &= oriented_aspect(sheet.rest(b), sheet.rest(c), sheet.rest(d)) < thinnest;
  });
  return sound;
}

}  // namespace

/// Leaves out vertices of the path, one after the other along it, where the edge that replaces two is not too long.
void GlobalRemesh::simplify_path(Sheet& sheet, double longest) {
  reshape_.begin(sheet, curve_);
  const std::vector<VertexIndex> vertices = sheet.log().path_vertices;
  for (const VertexIndex v : vertices) {
    if (!sheet.triangle_of_vertex(v).valid()) continue;
    std::vector<HalfEdge> pieces;
    for_each_outgoing(sheet, v, [&](HalfEdge h) {
      if (sheet.mark(h) == EdgeMark::path) pieces.push_back(h);
    });
    if (pieces.size() != 2) continue;
    const Point2 across = sheet.rest(sheet.target(pieces[1])) - sheet.rest(sheet.target(pieces[0]));
    if (squared_length(across) > longest * longest || !reshape_.may_leave_out(v, pieces[0])) continue;
    for (const HalfEdge h : pieces)
      if (is_sound_after_collapse(sheet, h) && sheet.collapse(h)) break;
  }
}

void GlobalRemesh::improve(Sheet& sheet, MethodNotes& notes) {
  // With triangles whose longest edge is at most this, their number comes out near that of the sheet.
  constexpr double longest_edge = 1.5;
  const double h = sheet.mean_edge();
  if (simplifies_) simplify_path(sheet, longest_edge * h);
  wedges_.find(sheet);
  sheet_.clear(sheet);
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) sheet_.add(TriangleIndex(t));
  mesher_.convert(sheet, sheet_, false);
  const bool complete =
      mesher_.insert(sheet) && mesher_.refine(sheet, {.max_aspect = 3,
                                                      .max_edge = longest_edge * h,
                                                      .min_edge = 1e-3 * h,
                                                      .most_vertices = 4 * sheet_.triangles().size() + 1000,
                                                      .wedges = &wedges_});
  notes.stopped_early = notes.improved_nothing = !complete || !mesher_.put_back(sheet);
}

}  // namespace cutbench
