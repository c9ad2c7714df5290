// RegionMesher's last step: from CGAL's triangulation back to the sheet.
#include <algorithm>

#include "harness/base/conversions.h"
#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "methods/tools/region_mesh.h"

namespace cutbench {

/// The triangle of the region that holds the vertex, which sees the known one: among those that the line between them
/// meets, or where rounding led it off the region, by a look at all.
TriangleIndex RegionMesher::Work::find(const Sheet& sheet, const Vertex& from, const Vertex& vertex) {
  const Point2 known = from_cgal(from->point()), p = from_cgal(vertex->point());
  const auto holds = [&](TriangleIndex t) {
    const auto c = sheet.corners(t);
    return orientation(c[0], c[1], p) >= 0 && orientation(c[1], c[2], p) >= 0 && orientation(c[2], c[0], p) >= 0;
  };
  const auto meets_line = [&](Point2 a, Point2 b) {
    return orientation(a, b, known) * orientation(a, b, p) <= 0 &&
           orientation(known, p, a) * orientation(known, p, b) <= 0;
  };
  met.clear(sheet.triangle_slots());
  on_line.clear();
  const auto meet = [&](TriangleIndex t) {
    if (region->holds(t) && met.insert(t)) on_line.push_back(t);
  };
  if (from->info().vertex.valid()) {
    for_each_outgoing(sheet, from->info().vertex, [&](HalfEdge h) { meet(triangle_of(h)); });
  } else {
    meet(from->info().triangle);
    if (const HalfEdge h = from->info().divides; h.valid() && !sheet.on_border(h)) {
      meet(triangle_of(h));
      meet(triangle_of(sheet.opposite(h)));
    }
  }
  for (std::size_t i = 0; i < on_line.size(); ++i) {
    const TriangleIndex t = on_line[i];
    if (holds(t)) return t;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k), o = sheet.opposite(h);
      if (!o.valid() || sheet.mark(h) != EdgeMark::none) continue;
      if (meets_line(sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h)))) meet(triangle_of(o));
    }
  }
  const auto all = region->triangles();
  const auto other = std::find_if(all.begin(), all.end(), holds);
  return other == all.end() ? TriangleIndex() : *other;
}

/// Finds the new vertices on no constraint, and the triangles they lie in, from neighbour to neighbour.
bool RegionMesher::Work::locate_inner(const Sheet& sheet) {
  inner.clear();
  std::vector<Vertex> front;
  for (const VertexIndex v : points) front.push_back(handle_of(v));
  for (const Chain& chain : chains) front.insert(front.end(), chain.vertices.begin(), chain.vertices.end());
  while (!front.empty()) {
    const Vertex known = front.back();
    front.pop_back();
    auto face = mesh.incident_faces(known), done = face;
    do {
      if (!face->is_in_domain()) continue;
      for (int k = 0; k < 3; ++k) {
        const Vertex v = face->vertex(k);
        RegionVertex& info = v->info();
        if (info.vertex.valid() || info.divides.valid() || info.triangle.valid()) continue;
        info.triangle = find(sheet, known, v);
        if (!info.triangle.valid()) return false;
        inner.push_back(v);
        front.push_back(v);
      }
    } while (++face != done);
  }
  return true;
}

/// Where a new triangle away from incisions gets a deformed vertex from, if it is the first at one of its vertices: the
/// sheet hands it on to the others there.
int RegionMesher::Work::parent_of(const Sheet& sheet, const Face& face) const {
  for (int k = 0; k < 3; ++k) {
    RegionVertex& info = face->vertex(k)->info();
    if (!info.vertex.valid() || info.served || !info.triangle.valid()) continue;
    const auto& corners = sheet.triangle(info.triangle).vertex;
    const auto at_corner = std::find(corners.begin(), corners.end(), info.vertex) != corners.end();
    if (!at_corner ||
        std::any_of(corners.begin(), corners.end(), [&](VertexIndex v) { return of_vertex.at(v).on_incision; }))
      continue;
    info.served = true;
    return region->place_of(info.triangle);
  }
  return -1;
}

/// The half-edge of the sheet that the edge from a to b is, or is a part of. Where that edge is the border, the only
/// one it has.
HalfEdge RegionMesher::Work::edge_under(const Sheet& sheet, const Vertex& a, const Vertex& b) const {
  const RegionVertex &from = a->info(), &to = b->info();
  if (from.vertex.valid() && to.vertex.valid()) {
    const HalfEdge h = find_half_edge(sheet, from.vertex, to.vertex);
    return h.valid() ? h : find_half_edge(sheet, to.vertex, from.vertex);
  }
  const HalfEdge h = from.vertex.valid() ? to.divides : from.divides;
  if (!h.valid() || sheet.on_border(h)) return h;
  const Point2 along = sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h));
  return dot(from_cgal(b->point()) - from_cgal(a->point()), along) > 0 ? h : sheet.opposite(h);
}

/// The new triangles, without their new vertices; false where one of them is not positive.
bool RegionMesher::Work::collect_triangles(const Sheet& sheet) {
  faces.clear();
  added.clear();
  for (const auto& face : mesh.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    std::array<Vertex, 3> v{face->vertex(0), face->vertex(1), face->vertex(2)};
    if (orientation(from_cgal(v[0]->point()), from_cgal(v[1]->point()), from_cgal(v[2]->point())) <= 0) return false;
    Sheet::NewTriangle made;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face->is_constrained(RegionTriangulation::cw(to_int(k)))) continue;
      const HalfEdge h = edge_under(sheet, v[k], v[(k + 1) % 3]);
      if (!h.valid()) return false;
      made.mark[k] = sheet.mark(h);
      // Along an opened incision the triangle on the same side knows the vertices of that lip.
      if (made.mark[k] == EdgeMark::incision) made.parent = region->place_of(triangle_of(h));
    }
    if (made.parent < 0) made.parent = parent_of(sheet, face);
    faces.push_back(face);
    added.push_back(made);
  }
  return true;
}

bool RegionMesher::put_back(Sheet& sheet) {
  const bool done = work_->put_back(sheet);
  work_->mesh.clear();
  work_->chains.clear();  // else as much memory as the largest region took
  return done;
}

bool RegionMesher::Work::put_back(Sheet& sheet) {
  if (broken || !locate_inner(sheet) || !collect_triangles(sheet)) return false;
  for (const auto& chain : chains) {
    const Point2 a = sheet.rest(sheet.origin(chain.edge)), along = sheet.rest(sheet.target(chain.edge)) - a;
    for (const Vertex& v : chain.vertices) {
      const Point2 p = from_cgal(v->point());
      v->info().vertex = sheet.new_vertex(chain.edge, dot(p - a, along) / squared_length(along), p);
    }
  }
  for (const Vertex& v : inner) v->info().vertex = sheet.new_vertex(v->info().triangle, from_cgal(v->point()));
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) added[i].vertex[k] = faces[i]->vertex(to_int(k))->info().vertex;
  sheet.replace_cavity(region->triangles(), added);
  for (const auto& [v, d] : left_out) sheet.drop_vertex(v, d);
  return true;
}

}  // namespace cutbench
