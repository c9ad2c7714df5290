// Constraints on the vertices of an opened sheet: how a method can improve the finite elements without changing the
// geometry. x = C q has a row of C for each vertex; the unknowns q have the system C^T K C, C^T M C, C^T f
// (harness/fem/constraints/constraint_matrix.h). Or triangles that are one element together, a polygon
// (harness/fem/elements/polygon_element.h).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

/// A constrained vertex of the opened sheet: it is no unknown, but is extrapolated linearly from three masters. On an
/// axis on which it is held, it stays there.
struct Constraint {
  DeformedIndex vertex;
  std::array<DeformedIndex, 3> masters;  ///< unconstrained vertices, or phantom node i as Sheet::deformed_slots() + i
  std::array<double, 3>
      weights;       ///< barycentric coordinates of the vertex, of any sign, with sum 1; 0 leaves the master out
  double reach = 0;  ///< of the search that found it, at rest: what happens farther from the vertex does not change it
};

/// A penalty on the jump of the normal derivative, sum of jump[k] q[unknown[k]], across an edge at which two parts are
/// joined, one of them of a divided triangle: jump^2 times `stiffness` times the sheet's stiffness (N/m) is added to
/// q^T K q, and times `mass` times its density to q^T M q (Burman, Comptes Rendus 348 (2010)).
struct GhostEdge {
  std::array<DeformedIndex, 4> unknown;
  std::array<double, 4> jump;  ///< 1/length
  double stiffness, mass;      ///< length^2, length^4
};

/// Triangles of the opened sheet that are one element. Its boundary is one closed line that meets no vertex of the
/// opened sheet twice; an incision may run into it as a slit, each lip with vertices of its own.
struct Polygon {
  std::vector<DeformedIndex> corners;    ///< along the boundary, counter-clockwise; three or more
  std::vector<TriangleIndex> triangles;  ///< two or more
  std::vector<DeformedIndex> inside;     ///< the other vertices of the triangles: no unknowns, they go along
  double stabilisation = 0.5;            ///< tau > 0, dimensionless (harness/fem/elements/compound_sheet.h)
  bool operator==(const Polygon&) const = default;
};

/// A triangle of the sheet before all cuts as an element: one of the copies that cuts made of it, with its share of the
/// material, or a whole one beside these.
struct CopiedElement {
  TriangleIndex parent;                  ///< in the sheet before all cuts
  std::array<Point2, 3> corner;          ///< of the parent, in rest space
  std::array<DeformedIndex, 3> unknown;  ///< at its corners: vertices, or phantom nodes
  double share;                          ///< of the parent's area: what is material
  std::vector<TriangleIndex> triangles;  ///< of the opened sheet, in rising order: its material
  bool operator==(const CopiedElement&) const = default;
};

/// The area that stands for the mass of an unknown.
struct LumpedArea {
  DeformedIndex unknown;
  double area;
};

/// What a cut left of the polygons that there were before. It dissolved those that had a triangle which its log names.
struct PolygonsLeft {
  std::function<std::span<const TriangleIndex>(TriangleIndex)> of;  ///< that the triangle is in; none: in none
  std::span<const TriangleIndex> freed;  ///< slots of triangles of the dissolved ones, used or free now
};

struct Constraints {
  std::vector<Constraint> constraints = {};  ///< each vertex once
  std::vector<DeformedIndex> phantoms = {};  ///< unknowns that are no vertex: the one before all cuts each is a copy of
  std::vector<GhostEdge> ghosts = {};
  std::vector<CopiedElement> copied = {};  ///< those that bend instead of their triangles, each parent's once or more
  /// Instead of what C^T M C has for the unknowns of copied elements: each of them once. Empty: that.
  std::vector<LumpedArea> lumped = {};
  std::vector<Polygon> polygons = {};  ///< no triangle is in two
  bool empty() const { return constraints.empty() && polygons.empty(); }
  bool merge_triangles() const { return !polygons.empty(); }
  Constraints of_merged_triangles() const { return {.polygons = polygons}; }  ///< without those of vertices
};

}  // namespace cutbench
