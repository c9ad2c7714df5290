// Vertex snapping: the nearest vertices of the sheet move onto the path, and no triangle is added where that is
// possible.
//
// How it works. adapt: crossings whose distance from an end of their edge is at most `reach` of the edge are taken
// nearest first. That end moves to the nearest point of the path between the crossings before and after it round the
// vertex, and its edges are no longer crossed; its deformed position becomes that of the same material point before
// (Sheet::move). A vertex moves once, and only where the path passes it in one piece with nothing else inside its
// triangles, where no aspect ratio of these exceeds `max_aspect` (a triangle with all corners on a straight path would
// be flat), and where the sheet keeps the pieces that the exact path makes (methods/tools/path_graph.h). A border
// vertex moves along a straight border to where the path meets it; corners and vertices of older incisions stay. Before
// the crossings the tips are taken: a vertex of the tip's triangle or edge comes to the tip, the nearest that may, of
// those for which the tip's barycentric coordinate is at least 1 - `reach`, where the path that is left out on the way
// lies within `reach` of the longest edge at the vertex from the new way. embed: the Delaunay split of the triangles
// that are still crossed.
//
// Source: Serby, Harders and Szekely, A new approach to cutting into finite element models, 2001; Nienhuys and van der
// Stappen, A surgery simulation supporting cuts and finite element deformation, 2001 (both as others describe them, the
// second on its authors' page, too); SOFA's TriangleSetTopologyAlgorithms.inl (read: SnapAlongPath moves a vertex, not
// one of the border, that has a point of the path within the threshold to the mean of all crossings of its edges and of
// the points inside triangles within it).
// Promises: area, conforming; neither the exact path nor that vertices stay. Between moved vertices the incision takes
// short cuts inside the triangles of one vertex, and the method checks no tolerance there, so it promises no more than
// the sheet's longest edge. Measured: at most 0.28 mean edges.
// Where it fails: vertices that move towards each other flatten the triangle between them, and where they may not, the
// crossing is split after all. The rest mesh is no longer the user's; held vertices (Sheet::hold: pinned or loaded
// ones) stay, and keep their slivers. Nothing moves to corners of the path, nor to tips in reach of no vertex that may
// move, which keep their slivers.
#pragma once

#include <optional>

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_graph.h"

namespace cutbench {

class VertexSnap : public CuttingMethod {
 public:
  struct Options {
    double reach = 0.5;     ///< of the edge, from a vertex to the crossings it is moved for
    double max_aspect = 5;  ///< no triangle is pressed beyond it
  };
  explicit VertexSnap(const Options& options) : options_(options) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline&) override;

 private:
  std::optional<Point2> target(const Sheet& sheet) const;
  bool stays_near(const Sheet& sheet, int tip) const;

  Options options_;
  PathGraph path_;
  PathGraph::Run run_;
};

}  // namespace cutbench
