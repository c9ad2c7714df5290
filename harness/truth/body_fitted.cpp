// Delaunay refinement (Ruppert 1995; Shewchuk 2002) as in CGAL's 2D mesh generator, with the sheet's border and the
// cuts as constraints.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include <cmath>
#include <map>

#include "harness/cut/open.h"
#include "harness/mesh/predicates.h"
#include "harness/truth/problem.h"

namespace cutbench {

namespace {

using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

struct Constraints {
  std::vector<std::array<Point2, 2>> segments;
  double h = 0;
};

/// The ends of the border's straight parts, and places on the cuts at about every h.
Constraints constraints_of(const Specimen& specimen, const Sheet& sheet) {
  Constraints all;
  all.h = sheet.mean_edge();
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k) {
      HalfEdge h = half_edge(TriangleIndex(t), k);
      if (!sheet.on_border(h)) continue;
      // The border edge before it, and on from a corner to the next.
      const auto turns = [&](HalfEdge before, HalfEdge after) {
        return cross(sheet.rest(sheet.target(before)) - sheet.rest(sheet.origin(before)),
                     sheet.rest(sheet.target(after)) - sheet.rest(sheet.origin(after))) != 0;
      };
      const auto next_on_border = [&](HalfEdge edge) { return sheet.first_spoke(sheet.target(edge)); };
      HalfEdge before = Sheet::previous(h);
      while (!sheet.on_border(before)) before = Sheet::previous(sheet.opposite(before));
      if (!turns(before, h)) continue;
      const Point2 from = sheet.rest(sheet.origin(h));
      while (!turns(h, next_on_border(h))) h = next_on_border(h);
      all.segments.push_back({from, sheet.rest(sheet.target(h))});
    }
  Polyline fine;
  for (const Curve& cut : specimen.cuts) {
    flatten(cut, 1e-4 * all.h, sheet.snap(), fine);
    std::vector<Point2> points = fine.points;
    if (fine.closed) points.push_back(points.front());
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) length += std::sqrt(squared_length(points[i] - points[i - 1]));
    const double step = length / std::max(1.0, std::round(length / all.h));
    // A straight cut is one constraint, which the refinement divides; a curve is entered at every step.
    double wanted = step, run = 0;
    Point2 last = points.front();
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double piece = std::sqrt(squared_length(points[i] - points[i - 1]));
      for (; fine.curved && wanted < length - step / 2 && wanted <= run + piece; wanted += step) {
        const Point2 p = points[i - 1] + (wanted - run) / piece * (points[i] - points[i - 1]);
        all.segments.push_back({last, p});
        last = p;
      }
      run += piece;
      if (!fine.curved || i + 1 == points.size()) all.segments.push_back({last, points[i]}), last = points[i];
    }
  }
  return all;
}

Triangulation mesh_of(const Constraints& constraints, double size) {
  Triangulation mesh;
  for (const auto& [a, b] : constraints.segments) mesh.insert_constraint(to_cgal(a), to_cgal(b));
  CGAL::refine_Delaunay_mesh_2(mesh, Criteria(0.125, size));
  return mesh;
}

std::size_t triangles_in(const Triangulation& mesh) {
  std::size_t count = 0;
  for (const auto& face : mesh.finite_face_handles()) count += face->is_in_domain();
  return count;
}

}  // namespace

Sheet body_fitted(const Specimen& specimen) {
  const Constraints constraints = constraints_of(specimen, Sheet(specimen.mesh));
  const auto wanted = static_cast<double>(specimen.mesh.triangles.size());
  // The number goes with 1 / size^2, roughly: a few steps come as near as it can be told.
  double size = 1.3 * constraints.h, best_size = size, best = 1e300;
  for (int step = 0; step < 8; ++step) {
    const auto count = static_cast<double>(triangles_in(mesh_of(constraints, size)));
    if (std::abs(count - wanted) < best) best = std::abs(count - wanted), best_size = size;
    if (best <= 0.01 * wanted) break;
    size *= std::sqrt(count / wanted);
  }
  const Triangulation mesh = mesh_of(constraints, best_size);

  MeshData data;
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  std::vector<std::array<bool, 3>> cut;  // per triangle and edge
  for (const auto& face : mesh.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    auto& triangle = data.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto [entry, fresh] = number.emplace(face->vertex(k), static_cast<std::int32_t>(data.rest.size()));
      if (fresh) data.rest.push_back({face->vertex(k)->point().x(), face->vertex(k)->point().y()});
      triangle[static_cast<std::size_t>(k)] = entry->second;
    }
    // CGAL's edge k is opposite corner k.
    cut.push_back({face->is_constrained(2), face->is_constrained(0), face->is_constrained(1)});
  }
  for (Point2 p : data.rest) data.deformed.push_back({p.x, p.y, 0});
  Sheet sheet(data);
  sheet.begin_cut();
  for (std::size_t t = 0; t < cut.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (cut[t][static_cast<std::size_t>(k)] && !sheet.on_border(h)) sheet.set_mark(h, EdgeMark::path);
    }
  open_path(sheet);
  sheet.begin_cut();
  return sheet;
}

}  // namespace cutbench
