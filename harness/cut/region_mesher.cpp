#include "harness/cut/region_mesher.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

// The mesh generator's own assertions in every build: without them it goes on, and crashes, with a midpoint that
// rounding put beyond both triangles at its edge.
#pragma push_macro("CGAL_assertion")
#undef CGAL_assertion
#define CGAL_assertion(EX) ((EX) ? static_cast<void>(0) : CGAL::assertion_fail(#EX, __FILE__, __LINE__))
#pragma push_macro("CGAL_assume")
#undef CGAL_assume
#define CGAL_assume(EX) CGAL_assertion(EX)
#include <CGAL/Delaunay_mesher_2.h>
#pragma pop_macro("CGAL_assume")
#pragma pop_macro("CGAL_assertion")

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/cut/patch.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/quality.h"
#include "harness/mesh/star.h"

namespace cutbench {

namespace {

struct MesherVertex {
  VertexIndex vertex;      // of the sheet; invalid: the mesh generator made it
  TriangleIndex triangle;  // of the region, which holds it
  HalfEdge divides;        // the constraint that a new vertex lies on
  bool served = false;     // a new triangle at it has its deformed vertex
};

using MesherVertexBase =
    CGAL::Delaunay_mesh_vertex_base_2<Kernel, CGAL::Triangulation_vertex_base_with_info_2<MesherVertex, Kernel>>;
using MesherStructure = CGAL::Triangulation_data_structure_2<MesherVertexBase, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel, MesherStructure, CGAL::Exact_predicates_tag>;
using Vertex = Mesh::Vertex_handle;

Point2 from_cgal(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

/// What CGAL's mesh generator asks of every triangle.
class ShapeCriteria {
 public:
  using Quality = double;  // the worst come first: those of small quality; 1 is good enough

  class Is_bad {  // NOLINT(readability-identifier-naming): CGAL's name
   public:
    explicit Is_bad(const RegionMesher::Limits& limits) : limits_(limits) {}
    CGAL::Mesh_2::Face_badness operator()(Quality quality) const {
      return quality < 1 ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    CGAL::Mesh_2::Face_badness operator()(const Mesh::Face_handle& face, Quality& quality) const {
      const std::array<Point2, 3> c{from_cgal(face->vertex(0)->point()), from_cgal(face->vertex(1)->point()),
                                    from_cgal(face->vertex(2)->point())};
      if (!(cross(c[1] - c[0], c[2] - c[0]) > 0)) {  // for doubles: it has no circumcentre to put a vertex at
        quality = 1;
        return (*this)(quality);
      }
      const double longest =
          std::sqrt(std::max({squared_length(c[1] - c[0]), squared_length(c[2] - c[1]), squared_length(c[0] - c[2])}));
      quality = std::min(limits_.max_edge / longest, limits_.max_aspect / aspect_ratio(c[0], c[1], c[2]));
      if (quality < 1 && (longest < limits_.min_edge || (limits_.wedges && limits_.wedges->hold(c)))) quality = 1;
      return (*this)(quality);
    }

   private:
    const RegionMesher::Limits& limits_;
  };

  explicit ShapeCriteria(const RegionMesher::Limits& limits) : limits_(limits) {}
  Is_bad is_bad_object() const { return Is_bad(limits_); }

 private:
  const RegionMesher::Limits& limits_;
};

using Mesher = CGAL::Delaunay_mesher_2<Mesh, ShapeCriteria>;

/// Inside the region or outside: beside it, too, a vertex has one deformed vertex per side.
bool is_on_incision(const Sheet& sheet, VertexIndex v) {
  bool found = false;
  for_each_spoke(sheet, v, [&](HalfEdge h) {
    found |= sheet.mark(h) == EdgeMark::incision || sheet.mark(Sheet::previous(h)) == EdgeMark::incision;
  });
  return found;
}

}  // namespace

struct RegionMesher::Work {
  /// A constraint that the mesh generator divided, and its new vertices from the origin on.
  struct Chain {
    HalfEdge edge;
    std::vector<Vertex> vertices;
  };

  bool in_region(HalfEdge h) const { return number[triangle_of(h)()] >= 0; }
  void mark_domain(const Sheet& sheet);
  bool find_chains(const Sheet& sheet);
  bool follow(Vertex from, Vertex first, Chain& chain) const;
  static bool goes_along(const Sheet& sheet, const Chain& chain);
  TriangleIndex find(const Sheet& sheet, const Vertex& from, const Vertex& vertex);
  bool locate_inner(const Sheet& sheet);
  bool collect_triangles(const Sheet& sheet);
  bool put_back(Sheet& sheet);
  HalfEdge edge_under(const Sheet& sheet, const Vertex& a, const Vertex& b) const;
  int parent_of(const Sheet& sheet, const Mesh::Face_handle& face) const;

  std::vector<TriangleIndex> region;
  std::vector<int> number;            // per triangle slot: place in the region; -1 where it isn't
  std::vector<HalfEdge> constraints;  // with the region on their left
  std::vector<VertexIndex> points;
  std::vector<std::pair<VertexIndex, DeformedIndex>> left_out;
  std::vector<std::uint8_t> use;  // per vertex: left out, used, on an incision
  std::vector<Vertex> handle_of;  // per vertex of the sheet; unset where it isn't in the mesh
  Mesh mesh;
  bool broken = false;  // the mesh generator gave up half-way, or doubles were too coarse
  std::vector<Chain> chains;
  std::vector<Vertex> inner;          // new vertices on no constraint
  std::vector<std::uint32_t> met_in;  // per triangle slot: the search that met it last
  std::uint32_t search = 0;
  std::vector<TriangleIndex> on_line;
  std::vector<HalfEdge> divided;
  std::vector<Mesh::Face_handle> faces;
  std::vector<Sheet::NewTriangle> added;
};

RegionMesher::RegionMesher() : work_(std::make_unique<Work>()) {}
RegionMesher::~RegionMesher() = default;
const std::vector<HalfEdge>& RegionMesher::divided() const { return work_->divided; }

void RegionMesher::convert(const Sheet& sheet, std::span<const TriangleIndex> region, bool with_inner_vertices) {
  Work& w = *work_;
  w.region.assign(region.begin(), region.end());
  w.number.assign(sheet.triangle_slots(), -1);
  for (std::size_t i = 0; i < region.size(); ++i) w.number[region[i]()] = static_cast<int>(i);
  w.use.assign(sheet.vertex_slots(), 0);
  w.constraints.clear(), w.points.clear(), w.left_out.clear();
  for (const TriangleIndex t : region)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k), o = sheet.opposite(h);
      if (o.valid() && w.in_region(o) && sheet.mark(h) == EdgeMark::none) continue;
      for (const VertexIndex v : {sheet.origin(h), sheet.target(h)})
        if (w.use[v()] == 0) w.use[v()] = is_on_incision(sheet, v) ? 2 : 1;
      if (!o.valid() || !w.in_region(o) || h < o) w.constraints.push_back(h);
    }
  std::vector<std::uint8_t> met(sheet.vertex_slots());
  for (const TriangleIndex t : region)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexIndex v = sheet.triangle(t).vertex[k];
      if (std::exchange(met[v()], 1)) continue;
      if (with_inner_vertices || w.use[v()] > 0 || sheet.is_held(v))
        w.points.push_back(v);
      else
        w.left_out.emplace_back(v, sheet.triangle(t).deformed[k]);
    }
}

bool RegionMesher::insert(const Sheet& sheet) {
  Work& w = *work_;
  w.mesh.clear();
  w.handle_of.assign(sheet.vertex_slots(), Vertex());
  Mesh::Face_handle hint;
  for (const VertexIndex v : w.points) {
    const Vertex handle = w.mesh.insert(to_cgal(sheet.rest(v)), hint);
    handle->info() = {};
    handle->info().vertex = v;
    w.handle_of[v()] = handle;
    hint = handle->face();
  }
  for (const TriangleIndex t : w.region)
    for (const VertexIndex v : sheet.triangle(t).vertex)
      if (const auto& handle = w.handle_of[v()]; handle != Vertex()) handle->info().triangle = t;
  for (const HalfEdge h : w.constraints)
    w.mesh.insert_constraint(w.handle_of[sheet.origin(h)()], w.handle_of[sheet.target(h)()]);
  return w.mesh.number_of_vertices() == w.points.size();
}

/// Tells the mesh generator what it must leave alone: all that lies beyond the region's border.
void RegionMesher::Work::mark_domain(const Sheet& sheet) {
  for (const auto& face : mesh.all_face_handles()) face->set_in_domain(true);
  Mesher::propagate_marks(mesh.infinite_face(), false);
  for (const HalfEdge h : constraints) {
    const HalfEdge o = sheet.opposite(h);
    if (o.valid() && in_region(o)) continue;
    Mesh::Face_handle face;
    int i = 0;
    if (!mesh.is_edge(handle_of[sheet.origin(h)()], handle_of[sheet.target(h)()], face, i)) continue;
    if (face->vertex(Mesh::ccw(i)) == handle_of[sheet.origin(h)()]) face = face->neighbor(i);
    if (face->is_in_domain()) Mesher::propagate_marks(face, false);
  }
}

bool RegionMesher::refine(const Sheet& sheet, const Limits& limits) {
  Work& w = *work_;
  w.broken = false;
  w.mark_domain(sheet);
  Mesher mesher(w.mesh, ShapeCriteria(limits));
  mesher.init(true);
  bool done = false;
  const std::size_t vertices_before = w.mesh.number_of_vertices();
  std::size_t made = 0;
  try {
    while (made < limits.most_vertices && mesher.step_by_step_refine_mesh()) ++made;
    done = mesher.is_refinement_done();
  } catch (const CGAL::Assertion_exception&) {
    w.broken = w.mesh.number_of_vertices() != vertices_before + made;  // in the middle of a change
  }
  w.broken |= !w.find_chains(sheet);
  return done && !w.broken;
}

/// The vertices along a divided constraint, from one vertex of the sheet to the next; false where it gets lost.
bool RegionMesher::Work::follow(Vertex from, Vertex first, Chain& chain) const {
  chain.vertices.assign(1, first);
  Vertex before = from;
  for (Vertex here = first;;) {
    Vertex next;
    int constrained = 0;
    auto face = mesh.incident_faces(here), done = face;
    do {
      const int i = face->index(here);
      if (!face->is_constrained(Mesh::ccw(i))) continue;  // the edge from `here` to its clockwise neighbour
      ++constrained;
      if (const Vertex end = face->vertex(Mesh::cw(i)); end != before) next = end;
    } while (++face != done);
    if (constrained != 2 || next == Vertex()) return false;
    before = here, here = next;
    chain.vertices.push_back(here);
    if (here->info().vertex.valid()) return true;
  }
}

/// Do the vertices, rounded, follow one another along the edge? Which lip a piece of it belongs to is told by that.
bool RegionMesher::Work::goes_along(const Sheet& sheet, const Chain& chain) {
  Point2 before = sheet.rest(sheet.origin(chain.edge));
  const Point2 end = sheet.rest(sheet.target(chain.edge)), along = end - before;
  for (const Vertex& vertex : chain.vertices) {
    const Point2 p = from_cgal(vertex->point());
    if (!(dot(p - before, along) > 0)) return false;
    before = p;
  }
  return dot(end - before, along) > 0;
}

bool RegionMesher::Work::find_chains(const Sheet& sheet) {
  chains.clear(), divided.clear();
  for (const VertexIndex v : points) {
    const Vertex start = handle_of[v()];
    auto face = mesh.incident_faces(start), done = face;
    do {
      const int i = face->index(start);
      const Vertex first = face->vertex(Mesh::cw(i));
      if (!face->is_constrained(Mesh::ccw(i)) || mesh.is_infinite(first) || first->info().vertex.valid()) continue;
      Chain chain;
      if (!follow(start, first, chain)) return false;
      const VertexIndex end = chain.vertices.back()->info().vertex;
      if (end < v) continue;  // found from its other end
      chain.vertices.pop_back();
      chain.edge = find_spoke(sheet, v, end);
      if (!chain.edge.valid()) {
        chain.edge = find_spoke(sheet, end, v);
        std::reverse(chain.vertices.begin(), chain.vertices.end());
      }
      if (!chain.edge.valid() || !goes_along(sheet, chain)) return false;
      const HalfEdge o = sheet.opposite(chain.edge);
      if (o.valid() && in_region(o) != in_region(chain.edge)) divided.push_back(chain.edge);
      for (const Vertex& vertex : chain.vertices) {
        vertex->info().divides = chain.edge;
        vertex->info().triangle = triangle_of(in_region(chain.edge) ? chain.edge : o);
      }
      chains.push_back(std::move(chain));
    } while (++face != done);
  }
  return true;
}

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
  met_in.resize(sheet.triangle_slots());
  ++search;
  on_line.clear();
  const auto meet = [&](TriangleIndex t) {
    if (number[t()] >= 0 && std::exchange(met_in[t()], search) != search) on_line.push_back(t);
  };
  if (from->info().vertex.valid()) {
    for_each_spoke(sheet, from->info().vertex, [&](HalfEdge h) { meet(triangle_of(h)); });
  } else {
    meet(from->info().triangle);
    if (const HalfEdge h = from->info().divides; h.valid() && !sheet.on_border(h))
      meet(triangle_of(h)), meet(triangle_of(sheet.opposite(h)));
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
  const auto other = std::find_if(region.begin(), region.end(), holds);
  return other == region.end() ? TriangleIndex() : *other;
}

/// Finds the new vertices on no constraint, and the triangles they lie in, from neighbour to neighbour.
bool RegionMesher::Work::locate_inner(const Sheet& sheet) {
  inner.clear();
  std::vector<Vertex> front;
  for (const VertexIndex v : points) front.push_back(handle_of[v()]);
  for (const Chain& chain : chains) front.insert(front.end(), chain.vertices.begin(), chain.vertices.end());
  while (!front.empty()) {
    const Vertex known = front.back();
    front.pop_back();
    auto face = mesh.incident_faces(known), done = face;
    do {
      if (!face->is_in_domain()) continue;
      for (int k = 0; k < 3; ++k) {
        const Vertex v = face->vertex(k);
        MesherVertex& info = v->info();
        if (info.vertex.valid() || info.divides.valid() || info.triangle.valid()) continue;
        info.triangle = find(sheet, known, v);
        if (!info.triangle.valid()) return false;
        inner.push_back(v), front.push_back(v);
      }
    } while (++face != done);
  }
  return true;
}

/// Where a new triangle away from incisions gets a deformed vertex from, if it is the first at one of its vertices: the
/// sheet hands it on to the others there.
int RegionMesher::Work::parent_of(const Sheet& sheet, const Mesh::Face_handle& face) const {
  for (int k = 0; k < 3; ++k) {
    MesherVertex& info = face->vertex(k)->info();
    if (!info.vertex.valid() || info.served || !info.triangle.valid()) continue;
    const auto& corners = sheet.triangle(info.triangle).vertex;
    const auto at_corner = std::find(corners.begin(), corners.end(), info.vertex) != corners.end();
    if (!at_corner || std::any_of(corners.begin(), corners.end(), [&](VertexIndex v) { return use[v()] == 2; }))
      continue;
    info.served = true;
    return number[info.triangle()];
  }
  return -1;
}

/// The half-edge of the sheet that the edge from a to b is, or is a part of. Where that edge is the border, the only
/// one it has.
HalfEdge RegionMesher::Work::edge_under(const Sheet& sheet, const Vertex& a, const Vertex& b) const {
  const MesherVertex &from = a->info(), &to = b->info();
  if (from.vertex.valid() && to.vertex.valid()) {
    const HalfEdge h = find_spoke(sheet, from.vertex, to.vertex);
    return h.valid() ? h : find_spoke(sheet, to.vertex, from.vertex);
  }
  const HalfEdge h = from.vertex.valid() ? to.divides : from.divides;
  if (!h.valid() || sheet.on_border(h)) return h;
  const Point2 along = sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h));
  return dot(from_cgal(b->point()) - from_cgal(a->point()), along) > 0 ? h : sheet.opposite(h);
}

/// The new triangles, without their new vertices; false where one of them is not positive.
bool RegionMesher::Work::collect_triangles(const Sheet& sheet) {
  faces.clear(), added.clear();
  for (const auto& face : mesh.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    std::array<Vertex, 3> v{face->vertex(0), face->vertex(1), face->vertex(2)};
    if (orientation(from_cgal(v[0]->point()), from_cgal(v[1]->point()), from_cgal(v[2]->point())) <= 0) return false;
    Sheet::NewTriangle made;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face->is_constrained(Mesh::cw(static_cast<int>(k)))) continue;
      const HalfEdge h = edge_under(sheet, v[k], v[(k + 1) % 3]);
      if (!h.valid()) return false;
      made.mark[k] = sheet.mark(h);
      // Along an opened incision the triangle on the same side knows the vertices of that lip.
      if (made.mark[k] == EdgeMark::incision) made.parent = number[triangle_of(h)()];
    }
    if (made.parent < 0) made.parent = parent_of(sheet, face);
    faces.push_back(face), added.push_back(made);
  }
  return true;
}

bool RegionMesher::put_back(Sheet& sheet) {
  const bool done = work_->put_back(sheet);
  work_->mesh.clear(), work_->chains.clear();  // else as much memory as the largest region took
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
    for (std::size_t k = 0; k < 3; ++k) added[i].vertex[k] = faces[i]->vertex(static_cast<int>(k))->info().vertex;
  sheet.replace_cavity(region, added);
  for (const auto& [v, d] : left_out) sheet.drop_vertex(v, d);
  return true;
}

void find_changed(const Sheet& sheet, std::vector<TriangleIndex>& region) {
  const EditLog& log = sheet.log();
  region.clear();
  for (const auto& touched : log.touched)
    if (sheet.triangle(touched.slot).alive()) region.push_back(touched.slot);
  for (std::size_t t = log.triangles_before; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) region.emplace_back(t);
}

void grow_region(const Sheet& sheet, int rings, std::vector<TriangleIndex>& region) {
  std::vector<std::uint8_t> inside(sheet.triangle_slots());
  std::erase_if(region, [&](TriangleIndex t) { return std::exchange(inside[t()], std::uint8_t{1}) != 0; });
  const auto add = [&](TriangleIndex t) {
    if (!std::exchange(inside[t()], 1)) region.push_back(t);
  };
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = region.size();
    for (; begin < end; ++begin)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge o = sheet.opposite(half_edge(region[begin], k)); o.valid()) add(triangle_of(o));
  }
  const auto sees_right_angle = [&](HalfEdge h) {  // or a wider one, at the corner opposite h
    const Point2 c = sheet.rest(sheet.origin(Sheet::previous(h)));
    return dot(sheet.rest(sheet.origin(h)) - c, sheet.rest(sheet.target(h)) - c) <= 0;
  };
  for (std::size_t i = 0; i < region.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(region[i], k), o = sheet.opposite(h);
      if (o.valid() && !inside[triangle_of(o)()] && (sees_right_angle(h) || sees_right_angle(o))) add(triangle_of(o));
    }
}

}  // namespace cutbench
