// Vertex snapping: the nearest vertices of the sheet move onto the path, and no triangle is added where that works.
//
// How it works: crossings whose distance to an end of their edge is at most `reach` of the edge are taken nearest
// first. That end moves to the nearest point of the path between the crossings before and after it round the vertex,
// and all crossings of its edges are gone; the deformed position is that of the same material point before
// (Sheet::move). A vertex moves once, and only where the path passes it in one go with nothing else inside its
// triangles, where none of these is pressed flatter than `max_aspect` (one with all corners on a straight path would
// be flat), and where the sheet falls apart as before (methods/tools/path_graph.h). A border vertex slides along a
// straight border to where the path meets that; corners and vertices of older incisions stay. Crossings that are left
// over are split, with the Delaunay diagonal in each crossed triangle.
//
// Source: Serby, Harders and Szekely, A new approach to cutting into finite element models, 2001; Nienhuys and van der
// Stappen, A surgery simulation supporting cuts and finite element deformation, 2001 (both as others describe them).
// Promises: area, conforming; neither the exact path nor that vertices stay.
// Fails: vertices that move towards each other flatten the triangle between them, and where they may not, the crossing
// is split after all. The rest mesh is no longer the one the user made; held vertices (Sheet::hold: pinned or loaded
// ones) stay, and keep their slivers. Nothing moves to tips and corners of the path,
// which keep their slivers; between moved vertices the incision takes short cuts.
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

  Options options_;
  PathGraph path_;
  PathGraph::Run run_;
};

}  // namespace cutbench
