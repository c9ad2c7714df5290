#include "harness/path/clear_of_seams.h"

#include <algorithm>
#include <utility>

#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/unroll.h"

namespace cutbench {

namespace {

bool is_cut(const Sheet& sheet) {
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(TriangleIndex(i), k);
          sheet.triangle(TriangleIndex(i)).alive() && sheet.mark(h) == EdgeMark::incision)
        return true;
  return false;
}

/// \pre no incision: deformed vertices are those of the mesh
std::pair<std::int32_t, std::int32_t> in_file(const MeshData& mesh, const Sheet& sheet, HalfEdge h) {
  const auto number = [&](HalfEdge at) {
    const DeformedIndex d = sheet.triangle(triangle_of(at)).deformed[to_size(corner_of(at))];
    return mesh.file_vertices[to_size(mesh.sewn[d()])];
  };
  return std::minmax({number(h), number(Sheet::next(h))});
}

}  // namespace

void clear_of_seams(MeshData& mesh, const std::string& mesh_name, std::span<const AnyCurve> path,
                    const std::string& path_name) {
  if (!mesh.unrolled) return;
  for (FileEdges whole;;) {
    const Sheet sheet(mesh);
    if (is_cut(sheet)) return;
    std::vector<HalfEdge> along;
    curves_at_rest(path, sheet, path_name, &along);
    const std::size_t before = whole.size();
    for (const HalfEdge h : along) whole.insert(in_file(mesh, sheet, h));
    if (whole.size() == before) return;
    std::vector<std::string> notes = std::move(mesh.notes);
    unroll_anew(mesh, mesh_name, whole);
    check_and_repair(mesh, mesh_name);
    mesh.notes = std::move(notes);
  }
}

}  // namespace cutbench
