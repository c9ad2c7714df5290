// Coarser sheets, by CGAL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <utility>
#include <vector>

#include "experiments/advice/sheet_levels.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/locator.h"

namespace cutbench {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Surface::Vertex_index;

constexpr int iterations = 3;
constexpr double sharp = 0.94;         // cosine of the turn of a border, about 20 degrees: beyond it is a corner
constexpr double least_saving = 0.95;  // of the triangles

void refuse_incisions(const Sheet& sheet) {
  if (!sheet.seams().empty()) throw InputError("the sheet has seams, which remeshing does not keep");
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k)
      if (sheet.mark(half_edge(TriangleIndex(t), k)) == EdgeMark::incision)
        throw InputError("the sheet has incisions, which remeshing does not keep");
}

Surface surface_of(const MeshData& mesh) {
  Surface surface;
  std::vector<Vertex> vertices;
  for (const Point2 p : mesh.rest) vertices.push_back(surface.add_vertex({p.x, p.y, 0}));
  for (const auto& [a, b, c] : mesh.triangles)
    surface.add_face(vertices[to_size(a)], vertices[to_size(b)], vertices[to_size(c)]);
  return surface;
}

Point2 place(const Surface& surface, Vertex v) { return {surface.point(v).x(), surface.point(v).y()}; }

/// Does the border turn at the target of h?
bool is_corner(const Surface& surface, Surface::Halfedge_index h) {
  const Point2 at = place(surface, surface.target(h));
  const Point2 in = at - place(surface, surface.source(h)), out = place(surface, surface.target(surface.next(h))) - at;
  return dot(in, out) < sharp * length(in) * length(out);
}

/// Where a place at rest is in space, by the old triangle that holds it, or the nearest one of its border.
Point3 lifted(const Sheet& sheet, const Locator& locator, Point2 p) {
  const TriangleIndex t = triangle_at(sheet, locator.near(sheet, p), p);
  const auto c = sheet.corners(t);
  const double area2 = cross(c[1] - c[0], c[2] - c[0]);
  Point3 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = cross(c[(k + 1) % 3] - p, c[(k + 2) % 3] - p) / area2;
    sum = sum + weight * sheet.position(sheet.triangle(t).deformed[k]);
  }
  return sum;
}

}  // namespace

MeshData remeshed(const MeshData& mesh, double edge) {
  const Sheet sheet(mesh);
  refuse_incisions(sheet);
  Surface surface = surface_of(mesh);
  auto on_border = surface.add_property_map<Surface::Edge_index, bool>("e:border", false).first;
  auto corner = surface.add_property_map<Vertex, bool>("v:corner", false).first;
  for (const auto h : surface.halfedges()) {
    if (!surface.is_border(h)) continue;
    on_border[surface.edge(h)] = true;
    if (is_corner(surface, h)) corner[surface.target(h)] = true;
  }
  pmp::isotropic_remeshing(surface.faces(), edge, surface,
                           pmp::parameters::number_of_iterations(iterations)
                               .edge_is_constrained_map(on_border)
                               .vertex_is_constrained_map(corner));
  surface.collect_garbage();

  const Locator locator(sheet);
  MeshData coarse;
  for (const Vertex v : surface.vertices()) {
    coarse.rest.push_back(place(surface, v));
    coarse.deformed.push_back(lifted(sheet, locator, coarse.rest.back()));
  }
  for (const auto face : surface.faces()) {
    auto& triangle = coarse.triangles.emplace_back();
    std::size_t k = 0;
    for (const Vertex v : surface.vertices_around_face(surface.halfedge(face))) triangle.at(k++) = to_int32(v.idx());
  }
  coarse.unrolled = mesh.unrolled;
  const auto count = to_int(coarse.triangles.size());
  check_and_repair(coarse, "the remeshed sheet");
  if (!coarse.notes.empty()) throw InputError("the remeshed sheet is folded");
  if (count > least_saving * to_double(mesh.triangles.size()))
    throw InputError("remeshing does not make the sheet coarser");
  return coarse;
}

}  // namespace cutbench
