#include "methods/cgal_cdt/cgal_cdt.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "harness/base/conversions.h"
#include "harness/cut/patch.h"
#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

namespace {

struct FaceInfo {
  int parent = -1;  // position of a triangle of the strip on the same side of every incision
  bool inside = false;
  std::array<EdgeMark, 3> mark{};  // of the edge opposite vertex i, as CGAL numbers them
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexIndex, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

}  // namespace

struct CgalCdt::Work {
  struct Constraint {
    VertexIndex a, b;
    int parent;      // the strip's triangle to the left of a -> b; -1: inside one
    bool two_sided;  // the strip goes on beyond it
    bool bounds;     // the strip ends there
    EdgeMark mark;
  };

  void collect(const Sheet& sheet, const Subdivision& trace);
  void triangulate();
  void mark_faces();
  void add_inside();

  Patch patch;
  std::vector<Constraint> constraints;
  std::size_t expected = 0;  // triangles, by Euler's formula
  std::vector<std::pair<VertexIndex, Point2>> points;
  StampedTable<VertexIndex, Triangulation::Vertex_handle> handle_of;  // per vertex of the sheet
  Triangulation triangulation;
  std::vector<Triangulation::Face_handle> front;
  std::vector<TriangleIndex> removed;
  std::vector<Sheet::NewTriangle> added;
};

/// The strip's points, border, incisions and path.
void CgalCdt::Work::collect(const Sheet& sheet, const Subdivision& trace) {
  constraints.clear();
  points.clear();
  removed.clear();
  expected = 0;
  handle_of.clear(sheet.vertex_slots());
  for (int f = 0; f < to_int(trace.faces.size()); ++f) {
    make_patch(sheet, trace, f, patch);
    removed.push_back(patch.triangle);
    expected += patch.ring.size() - 2 + 2 * patch.inside_count();
    for (std::size_t i = 0; i < patch.points.size(); ++i)
      if (handle_of.insert(patch.vertices[i])) points.emplace_back(patch.vertices[i], patch.points[i]);
    int edge = -1;
    for (std::size_t i = 0; i < patch.ring.size(); ++i) {
      if (patch.ring[i] < 3) ++edge;
      const HalfEdge o = sheet.opposite(half_edge(patch.triangle, edge));
      const bool strip_goes_on = o.valid() && trace.has_face(triangle_of(o));
      if (strip_goes_on && patch.ring_marks[i] == EdgeMark::none) continue;
      const auto a = to_size(patch.ring[i]);
      const auto b = to_size(patch.ring[i + 1 == patch.ring.size() ? 0 : i + 1]);
      constraints.push_back({patch.vertices[a], patch.vertices[b], f, false, !strip_goes_on,
                             strip_goes_on ? patch.ring_marks[i] : EdgeMark::none});
    }
    for (const auto& s : patch.segments)
      constraints.push_back(
          {patch.vertices[to_size(s[0])], patch.vertices[to_size(s[1])], -1, true, false, EdgeMark::path});
  }
}

void CgalCdt::Work::triangulate() {
  triangulation.clear();
  Triangulation::Face_handle hint;
  std::size_t distinct = 0;
  for (const auto& [v, p] : points) {
    const auto handle = triangulation.insert(to_cgal(p), hint);
    if (triangulation.number_of_vertices() != ++distinct)
      throw TooClose("CGAL: two points of the path became one, coordinates too close for doubles");
    handle->info() = v;
    handle_of.at(v) = handle;
    hint = handle->face();
  }
  try {
    for (const auto& c : constraints) triangulation.insert_constraint(handle_of.at(c.a), handle_of.at(c.b));
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw TooClose("CGAL: constraints cross after rounding, coordinates too close for doubles");
  }
}

/// Puts marks and parents on the faces beside the constraints, and finds the inside from there.
void CgalCdt::Work::mark_faces() {
  front.clear();
  const auto seed = [&](VertexIndex a, VertexIndex b, int parent, EdgeMark mark) {
    Triangulation::Face_handle face;  // is_edge gives the one with a -> b counter-clockwise
    int i = 0;
    if (!triangulation.is_edge(handle_of.at(a), handle_of.at(b), face, i))
      throw TooClose("CGAL: a constraint is not an edge, coordinates too close for doubles");
    if (face->vertex(Triangulation::ccw(i)) != handle_of.at(a)) {
      const auto other = face->neighbor(i);
      i = triangulation.mirror_index(face, i);
      face = other;
    }
    face->info().mark[to_size(i)] = mark;
    if (parent >= 0) face->info().parent = parent;
    if (!std::exchange(face->info().inside, true)) front.push_back(face);
  };
  for (const auto& c : constraints) {
    seed(c.a, c.b, c.parent, c.mark);
    if (c.two_sided) seed(c.b, c.a, -1, c.mark);
  }
  while (!front.empty()) {
    const auto face = front.back();
    front.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto neighbour = face->neighbor(i);
      if (face->is_constrained(i) || std::exchange(neighbour->info().inside, true)) continue;
      front.push_back(neighbour);
    }
  }
  for (const auto& c : constraints) {
    Triangulation::Face_handle face;
    int i = 0;
    if (!c.bounds || !triangulation.is_edge(handle_of.at(c.b), handle_of.at(c.a), face, i)) continue;
    if (face->vertex(Triangulation::ccw(i)) != handle_of.at(c.b)) face = face->neighbor(i);
    if (face->info().inside) throw TooClose("CGAL: the strip lost its shape, coordinates too close for doubles");
  }
}

void CgalCdt::Work::add_inside() {
  added.clear();
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    if (!face->info().inside) continue;
    Sheet::NewTriangle made;
    made.parent = face->info().parent;
    for (int k = 0; k < 3; ++k) {
      made.vertex[to_size(k)] = face->vertex(k)->info();
      made.mark[to_size(k)] = face->info().mark[to_size(Triangulation::cw(k))];
    }
    added.push_back(made);
  }
  if (added.size() != expected) throw TooClose("CGAL: the strip lost its shape, coordinates too close for doubles");
}

CgalCdt::CgalCdt() : work_(std::make_unique<Work>()) {}
CgalCdt::~CgalCdt() = default;

void CgalCdt::embed(Sheet& sheet, Subdivision& trace, MethodNotes&) {
  make_vertices(sheet, trace);
  work_->collect(sheet, trace);
  if (work_->removed.empty()) return;  // the path runs along edges only
  work_->triangulate();
  work_->mark_faces();
  work_->add_inside();
  sheet.replace_cavity(work_->removed, work_->added);
}

}  // namespace cutbench
