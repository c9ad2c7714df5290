// What the two halves of RegionMesher share: CGAL's triangulation, and where its vertices come from.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/stamped_table.h"
#include "methods/tools/region.h"
#include "methods/tools/region_mesher.h"

namespace cutbench {

inline Point2 from_cgal(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

/// With each vertex of the triangulation.
struct RegionVertex {
  VertexIndex vertex;      ///< of the sheet; invalid: the mesh generator made it
  TriangleIndex triangle;  ///< of the region, which holds it
  HalfEdge divides;        ///< the constraint that a new vertex lies on
  bool served = false;     ///< a new triangle at it has its deformed vertex
};

/// CGAL's kernel, but where the middle of an edge is, rounded, one of its ends: the mesh generator would look for a
/// point between them for ever. It ends with an exception instead, before it changes anything.
struct NoMiddle {};
struct RegionKernel : Kernel {
  struct Construct_midpoint_2 {  // NOLINT(readability-identifier-naming): CGAL's name
    Point_2 operator()(const Point_2& p, const Point_2& q) const {
      const Point_2 middle = CGAL::midpoint(p, q);
      if (middle == p || middle == q) throw NoMiddle();
      return middle;
    }
  };
  Construct_midpoint_2 construct_midpoint_2_object() const { return {}; }  // NOLINT: CGAL's name
};
using RegionVertexBase =
    CGAL::Delaunay_mesh_vertex_base_2<RegionKernel,
                                      CGAL::Triangulation_vertex_base_with_info_2<RegionVertex, RegionKernel>>;
using RegionStructure =
    CGAL::Triangulation_data_structure_2<RegionVertexBase, CGAL::Delaunay_mesh_face_base_2<RegionKernel>>;

/// CGAL's triangulation, but where rounding put the mesh generator's new vertex beyond the triangles that it replaces,
/// or on their border: a star round it would not be a triangulation any more, and CGAL would walk round it for ever.
/// The mesh generator ends with CGAL's Assertion_exception instead, in the middle of a change.
class RegionTriangulation
    : public CGAL::Constrained_Delaunay_triangulation_2<RegionKernel, RegionStructure, CGAL::Exact_predicates_tag> {
 public:
  template <class Edges, class Faces>
  Vertex_handle star_hole(const Point& p, Edges edges, Edges edges_end, Faces faces, Faces faces_end) {
    if (!sees_all_round(p, edges, edges_end, std::distance(faces, faces_end)))
      CGAL::assertion_fail("a vertex that sees the hole's border all round", __FILE__, __LINE__);
    return Constrained_Delaunay_triangulation_2::star_hole(p, edges, edges_end, faces, faces_end);
  }

 private:
  /// Is the border of the hole, whose edges are told by the faces beyond them, one loop about p, and a disk inside?
  template <class Edges>
  bool sees_all_round(const Point& p, Edges edges, Edges edges_end, std::ptrdiff_t faces) const {
    Vertex_handle before = std::prev(edges_end)->first->vertex(ccw(std::prev(edges_end)->second));
    for (Edges e = edges; e != edges_end; ++e) {
      const Vertex_handle from = e->first->vertex(cw(e->second)), to = e->first->vertex(ccw(e->second));
      if (from != before) return false;
      if (!is_infinite(from) && !is_infinite(to) &&
          geom_traits().orientation_2_object()(from->point(), to->point(), p) != CGAL::LEFT_TURN)
        return false;
      before = to;
    }
    return std::distance(edges, edges_end) == faces + 2;
  }
};

struct RegionMesher::Work {
  using Vertex = RegionTriangulation::Vertex_handle;
  using Face = RegionTriangulation::Face_handle;

  /// A constraint that the mesh generator divided, and its new vertices from the origin on.
  struct Chain {
    HalfEdge edge;
    std::vector<Vertex> vertices;
  };

  bool in_region(HalfEdge h) const { return region->holds(triangle_of(h)); }
  Vertex handle_of(VertexIndex v) const { return of_vertex.at(v).handle; }
  void mark_domain(const Sheet& sheet);
  bool find_chains(const Sheet& sheet);
  bool follow(Vertex from, Vertex first, Chain& chain) const;
  static bool goes_along(const Sheet& sheet, const Chain& chain);
  TriangleIndex find(const Sheet& sheet, const Vertex& from, const Vertex& vertex);
  bool locate_inner(const Sheet& sheet);
  bool collect_triangles(const Sheet& sheet);
  bool put_back(Sheet& sheet);
  HalfEdge edge_under(const Sheet& sheet, const Vertex& a, const Vertex& b) const;
  int parent_of(const Sheet& sheet, const Face& face) const;

  /// Of a vertex of the region.
  struct OfVertex {
    bool is_read = false, on_constraint = false, on_incision = false;
    Vertex handle{};  // unset where it isn't in the mesh
  };

  const Region* region = nullptr;
  std::vector<HalfEdge> constraints;  // with the region on their left
  std::vector<VertexIndex> points;
  std::vector<std::pair<VertexIndex, DeformedIndex>> left_out;
  StampedTable<VertexIndex, OfVertex> of_vertex;
  RegionTriangulation mesh;
  bool broken = false;  // the mesh generator gave up in the middle of a change, or doubles were too coarse
  std::vector<Chain> chains;
  std::vector<Vertex> inner;      // new vertices on no constraint
  StampedSet<TriangleIndex> met;  // by the search under way
  std::vector<TriangleIndex> on_line;
  std::vector<HalfEdge> divided;
  std::vector<Face> faces;
  std::vector<Sheet::NewTriangle> added;
};

}  // namespace cutbench
