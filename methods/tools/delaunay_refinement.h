// Delaunay refinement on the sheet itself, from some of its triangles on: local, so that its cost follows what there is
// to do.
//
// Each triangle that asks for it, and whose aspect ratio exceeds `bound`, gets a new vertex at its off-centre: the
// point on the bisector of its shortest edge, on the way to the circumcentre, that makes a triangle with that edge as
// slim as the bound allows. Where border, incision or path hide that point, or it would encroach upon a piece of them
// (lie in its diametral circle, and in the part of the sheet that the new vertex would change), that piece is divided
// instead: at its middle, or, where it meets another one at less than 60 degrees, at a distance from the corner that is
// a power of two, so that both legs get their vertices equally far out. No piece is divided before a point asks for it
// (lazily), though vertices of the sheet may lie in its circle. Triangles with the shortest edges come first. Those in
// forced wedges are left coarse. Where edges between a triangle and its off-centre are not Delaunay, as they may be
// after other work on shapes, they are flipped first (each lowers the lifted mesh, so that this ends): else the new
// vertex would leave the triangle as it is.
//
// Source: Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18, 1995
// (encroachment, shells); Ungor, Off-centers: a new type of Steiner points for computing size-optimal
// quality-guaranteed Delaunay triangulations, LATIN 2004 (neither read). Flips: harness/mesh/local_delaunay.h.
#pragma once

#include <vector>

#include "harness/mesh/local_delaunay.h"
#include "harness/mesh/stamped_table.h"
#include "methods/tools/forced_wedges.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class DelaunayRefinement {
 public:
  struct Options {
    double bound = 3;  ///< no aspect ratio beyond it; infinity: flips alone
    /// No piece of path, incision or border shorter than twice that is divided, mean rest edges.
    double min_edge = shortest_refined_edge;
    std::size_t per_path_vertex = 20;  ///< vertices that it may make, for each one of the path
    std::size_t most_vertices = 5000;  ///< and in all: a path with more to ask for leads across stacks of slivers
  };
  explicit DelaunayRefinement(const Options& options) : options_(options) {}

  /// Forgets what was asked for. \pre the path is embedded and still closed; `wedges` must live until the last run().
  void begin(const Sheet& sheet, const ForcedWedges& wedges);
  /// Asks for a vertex where t is ill-shaped.
  void note(const Sheet& sheet, TriangleIndex t);
  /// Asks for flips round t first, and then for vertices where what comes of it is ill-shaped.
  void flip_at(TriangleIndex t);
  /// Does what was asked for, and what comes of it. False where that would take more vertices than it may make: an
  /// aspect ratio of 3 is beyond what is proved to end.
  bool run(Sheet& sheet);

 private:
  bool is_ill_shaped(const Sheet& sheet, TriangleIndex t) const;
  Point2 off_centre(const Sheet& sheet, TriangleIndex t) const;
  bool find_encroached(const Sheet& sheet, TriangleIndex t, Point2 p);
  bool refine(Sheet& sheet, TriangleIndex t);
  bool split_segment(Sheet& sheet, HalfEdge h);
  bool flip_doubtful(Sheet& sheet);
  void flip_round(Sheet& sheet, VertexIndex v);
  void note_changed(const Sheet& sheet);

  /// A triangle by its shortest edge; of equals the one that was made first, so that every library's heap agrees.
  struct Entry {
    double squared_edge;
    TriangleIndex triangle;
    bool operator<(const Entry& other) const {
      if (squared_edge != other.squared_edge) return squared_edge > other.squared_edge;
      return triangle > other.triangle;
    }
  };

  Options options_;
  const ForcedWedges* wedges_ = nullptr;
  LocalDelaunay delaunay_;
  std::vector<Entry> heap_;  // shortest first; each may be improved or changed by the time it is looked at
  std::vector<TriangleIndex> cavity_;
  StampedSet<TriangleIndex> met_;  // in the cavity
  std::vector<HalfEdge> encroached_, doubtful_;
};

}  // namespace cutbench
