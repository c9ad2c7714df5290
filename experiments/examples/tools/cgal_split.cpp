// CGAL: PMP::split of the sheet by a ribbon through the path. Exact constructions, rounded where they are written.
// usage: cutbench_cgal_split mesh.obj path.json out.obj [time.json]
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Surface_mesh.h>

#include <fstream>
#include <set>

#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/mesh/sheet.h"
#include "harness/path/cut_failed.h"

namespace {

using namespace cutbench;
namespace pmp = CGAL::Polygon_mesh_processing;
using Surface = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
using Vertex = Surface::Vertex_index;

void add_face(Surface& surface, Vertex a, Vertex b, Vertex c) {
  if (surface.add_face(a, b, c) == Surface::null_face()) throw CutRefused("not a manifold, as Surface_mesh must be");
}

Surface surface_of(const MeshData& mesh) {
  std::set<std::pair<double, double>> places;
  Surface surface;
  for (const auto& [x, y] : mesh.rest) {
    if (!places.insert({x, y}).second) throw CutRefused("this adapter takes no sheet with an older incision");
    surface.add_vertex({x, y, 0});
  }
  for (const auto& [a, b, c] : mesh.triangles) add_face(surface, Vertex(a), Vertex(b), Vertex(c));
  return surface;
}

/// The path drawn up and down, unlike far: no edge of it lies in the sheet's plane.
Surface ribbon_through(const std::vector<Point2>& line) {
  Surface ribbon;
  const bool closed = line.front() == line.back();
  std::vector<std::array<Vertex, 2>> rungs;
  for (std::size_t i = 0; i + (closed ? 1 : 0) < line.size(); ++i)
    rungs.push_back({ribbon.add_vertex({line[i].x, line[i].y, -1}), ribbon.add_vertex({line[i].x, line[i].y, 0.9})});
  if (closed) rungs.push_back(rungs.front());
  for (std::size_t i = 0; i + 1 < rungs.size(); ++i) {
    add_face(ribbon, rungs[i][0], rungs[i + 1][0], rungs[i + 1][1]);
    add_face(ribbon, rungs[i][0], rungs[i + 1][1], rungs[i][1]);
  }
  return ribbon;
}

MeshData rounded(Surface& surface) {
  surface.collect_garbage();
  MeshData mesh;
  for (const auto& p : surface.points()) {
    mesh.rest.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y())});
    mesh.deformed.push_back({mesh.rest.back().x, mesh.rest.back().y, 0});
  }
  for (const auto f : surface.faces()) {
    std::array<std::int32_t, 3>& corners = mesh.triangles.emplace_back();
    std::size_t k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) corners[k++] = static_cast<int>(v.idx());
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: cutbench_cgal_split mesh path out [time]\n"), 1;
  try {
    const MeshData mesh = read_mesh(argv[1]);
    Polyline line;
    flatten(read_path(argv[2]).front(), 0.03 * Sheet(mesh).mean_edge(), 0, line);
    if (line.closed) line.points.push_back(Point2(line.points.front()));
    const std::clock_t start = std::clock();
    Surface sheet = surface_of(mesh), ribbon = ribbon_through(line.points);
    pmp::split(sheet, ribbon, CGAL::parameters::throw_on_self_intersection(true));
    const MeshData made = rounded(sheet);
    if (argc > 4) std::ofstream(argv[4]) << "{\"us\": " << std::clock() - start << "}\n";
    write_mesh(made, argv[3]);
  } catch (const InputError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  } catch (const std::exception& refused) {  // CGAL's own, too: a ribbon that crosses itself
    return std::fprintf(stderr, "%s\n", refused.what()), 3;
  }
}
