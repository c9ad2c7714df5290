// What the two halves of RegionMesher share: CGAL's triangulation, and where its vertices come from.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>
#include <vector>

#include "harness/cut/region.h"
#include "harness/cut/region_mesher.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/stamped_table.h"

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
/// point between them for ever. It ends with CGAL's Assertion_exception instead.
struct RegionKernel : Kernel {
  struct Construct_midpoint_2 {  // NOLINT(readability-identifier-naming): CGAL's name
    Point_2 operator()(const Point_2& p, const Point_2& q) const {
      const Point_2 middle = CGAL::midpoint(p, q);
      if (middle == p || middle == q) CGAL::assertion_fail("a point between the ends", __FILE__, __LINE__);
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
using RegionTriangulation =
    CGAL::Constrained_Delaunay_triangulation_2<RegionKernel, RegionStructure, CGAL::Exact_predicates_tag>;

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
  bool broken = false;  // the mesh generator gave up half-way, or doubles were too coarse
  std::vector<Chain> chains;
  std::vector<Vertex> inner;      // new vertices on no constraint
  StampedSet<TriangleIndex> met;  // by the search under way
  std::vector<TriangleIndex> on_line;
  std::vector<HalfEdge> divided;
  std::vector<Face> faces;
  std::vector<Sheet::NewTriangle> added;
};

}  // namespace cutbench
