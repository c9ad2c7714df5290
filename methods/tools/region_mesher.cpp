#include "methods/tools/region_mesher.h"

// Before the macros below: what other files include, too, must be the same there.
#include "methods/tools/region_mesh.h"

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
#include "harness/mesh/one_ring.h"
#include "harness/mesh/quality.h"

namespace cutbench {

RegionMesher::RegionMesher() : work_(std::make_unique<Work>()) {}
RegionMesher::~RegionMesher() = default;
const std::vector<HalfEdge>& RegionMesher::divided() const { return work_->divided; }

namespace {

/// Inside the region or outside: beside it, too, a vertex has one deformed vertex per side.
bool is_on_incision(const Sheet& sheet, VertexIndex v) {
  bool found = false;
  for_each_outgoing(sheet, v, [&](HalfEdge h) {
    found |= sheet.mark(h) == EdgeMark::incision || sheet.mark(Sheet::previous(h)) == EdgeMark::incision;
  });
  return found;
}

}  // namespace

void RegionMesher::convert(const Sheet& sheet, const Region& region, bool with_inner_vertices) {
  Work& w = *work_;
  w.region = &region;
  w.of_vertex.clear(sheet.vertex_slots());
  w.constraints.clear();
  w.points.clear();
  w.left_out.clear();
  const auto put_on_constraint = [&](VertexIndex v) {
    if (w.of_vertex.insert(v, {.on_constraint = true})) w.of_vertex.at(v).on_incision = is_on_incision(sheet, v);
  };
  for (const TriangleIndex t : region.triangles())
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k), o = sheet.opposite(h);
      if (o.valid() && w.in_region(o) && sheet.mark(h) == EdgeMark::none) continue;
      put_on_constraint(sheet.origin(h));
      put_on_constraint(sheet.target(h));
      if (!o.valid() || !w.in_region(o) || h < o) w.constraints.push_back(h);
    }
  for (const TriangleIndex t : region.triangles())
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexIndex v = sheet.triangle(t).vertex[k];
      w.of_vertex.insert(v);
      Work::OfVertex& of_v = w.of_vertex.at(v);
      if (std::exchange(of_v.is_read, true)) continue;
      if (with_inner_vertices || of_v.on_constraint || sheet.is_held(v))
        w.points.push_back(v);
      else
        w.left_out.emplace_back(v, sheet.triangle(t).deformed[k]);
    }
}

bool RegionMesher::insert(const Sheet& sheet) {
  Work& w = *work_;
  w.mesh.clear();
  RegionTriangulation::Face_handle hint;
  for (const VertexIndex v : w.points) {
    const Work::Vertex handle = w.mesh.insert(to_cgal(sheet.rest(v)), hint);
    handle->info() = {};
    handle->info().vertex = v;
    w.of_vertex.at(v).handle = handle;
    hint = handle->face();
  }
  for (const TriangleIndex t : w.region->triangles())
    for (const VertexIndex v : sheet.triangle(t).vertex)
      if (const Work::Vertex handle = w.handle_of(v); handle != Work::Vertex()) handle->info().triangle = t;
  for (const HalfEdge h : w.constraints)
    w.mesh.insert_constraint(w.handle_of(sheet.origin(h)), w.handle_of(sheet.target(h)));
  return w.mesh.number_of_vertices() == w.points.size();
}

namespace {

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
    CGAL::Mesh_2::Face_badness operator()(const RegionTriangulation::Face_handle& face, Quality& quality) const {
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

using Mesher = CGAL::Delaunay_mesher_2<RegionTriangulation, ShapeCriteria>;

}  // namespace

/// Tells the mesh generator what it must leave alone: all that lies beyond the region's border.
void RegionMesher::Work::mark_domain(const Sheet& sheet) {
  for (const auto& face : mesh.all_face_handles()) face->set_in_domain(true);
  Mesher::propagate_marks(mesh.infinite_face(), false);
  for (const HalfEdge h : constraints) {
    const HalfEdge o = sheet.opposite(h);
    if (o.valid() && in_region(o)) continue;
    RegionTriangulation::Face_handle face;
    int i = 0;
    if (!mesh.is_edge(handle_of(sheet.origin(h)), handle_of(sheet.target(h)), face, i)) continue;
    if (face->vertex(RegionTriangulation::ccw(i)) == handle_of(sheet.origin(h))) face = face->neighbor(i);
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
  try {
    for (std::size_t made = 0; made < limits.most_vertices && mesher.step_by_step_refine_mesh();) ++made;
    done = mesher.is_refinement_done();
  } catch (const NoMiddle&) {  // as far as doubles go
  } catch (const CGAL::Assertion_exception&) {
    w.broken = true;
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
      if (!face->is_constrained(RegionTriangulation::ccw(i)))
        continue;  // the edge from `here` to its clockwise neighbour
      ++constrained;
      if (const Vertex end = face->vertex(RegionTriangulation::cw(i)); end != before) next = end;
    } while (++face != done);
    if (constrained != 2 || next == Vertex()) return false;
    before = here;
    here = next;
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
  chains.clear();
  divided.clear();
  for (const VertexIndex v : points) {
    const Vertex start = handle_of(v);
    auto face = mesh.incident_faces(start), done = face;
    do {
      const int i = face->index(start);
      const Vertex first = face->vertex(RegionTriangulation::cw(i));
      if (!face->is_constrained(RegionTriangulation::ccw(i)) || mesh.is_infinite(first) || first->info().vertex.valid())
        continue;
      Chain chain;
      if (!follow(start, first, chain)) return false;
      const VertexIndex end = chain.vertices.back()->info().vertex;
      if (end < v) continue;  // found from its other end
      chain.vertices.pop_back();
      chain.edge = find_half_edge(sheet, v, end);
      if (!chain.edge.valid()) {
        chain.edge = find_half_edge(sheet, end, v);
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

}  // namespace cutbench
