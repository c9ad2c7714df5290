// Delaunay refinement of the cut's surroundings, on the sheet itself: what CGAL's mesh generator does (cgal_refine),
// but local, so that its cost follows the cut.
//
// How it works. embed: crossed triangles are divided along the path. improve: edges round the new vertices are flipped
// to constrained Delaunay; then each triangle that the cut made or changed and whose aspect ratio exceeds `bound` gets
// a new vertex at its off-centre: the point on the bisector of its shortest edge, on the way to the circumcentre, that
// makes a triangle with that edge as slim as the bound allows. Where border, incision or path hide that point, or it
// would encroach upon a piece of them (lie in its diametral circle, and in the part of the sheet that the new vertex
// would change), that piece is divided instead: at its middle, or, where it meets another one at less than 60 degrees,
// at a distance from the corner that is a power of two, so that both legs get their vertices equally far out. No piece
// is divided before a point asks for it (lazily), though vertices of the sheet may lie in its circle. Triangles with
// the shortest edges come first. Those in forced wedges (harness/cut/forced_wedges.h) are left coarse.
//
// Source: Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18, 1995
// (encroachment, shells); Ungor, Off-centers: a new type of Steiner points for computing size-optimal
// quality-guaranteed Delaunay triangulations, LATIN 2004. Flips: harness/mesh/local_delaunay.h.
// Promises: the exact path, area, conforming, no vertex moved.
// Fails: an aspect ratio of 3 is beyond what is proved to end, hence a limit on vertices, at which it stops and leaves
// the rest. A vertex close to the path stays where it is and costs dozens of vertices round it, the smallest of them as
// near to each other as it is to the path. Flips across old edges change the deformed surface where the sheet is bent.
#pragma once

#include <utility>

#include "harness/cut/cutting_method.h"
#include "harness/cut/embed_plainly.h"
#include "harness/cut/forced_wedges.h"
#include "harness/mesh/local_delaunay.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

class DelaunayRefine : public CuttingMethod {
 public:
  struct Options {
    double bound = 3;                  ///< no aspect ratio beyond it; infinity: flips alone
    double min_edge = 1e-4;            ///< no edge of path, incision or border is made shorter, in mean rest edges
    std::size_t per_path_vertex = 20;  ///< vertices that the refinement may make, for each one of the path
    std::size_t most_vertices = 5000;  ///< and in all: a path with more to ask for leads across stacks of slivers
  };
  explicit DelaunayRefine(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace) override;
  void improve(Sheet& sheet) override;
  int recovered_segments() const override { return recovered_; }
  bool stopped_early() const override { return stopped_early_; }

 private:
  bool is_ill_shaped(const Sheet& sheet, TriangleIndex t) const;
  Point2 off_centre(const Sheet& sheet, TriangleIndex t) const;
  bool find_encroached(const Sheet& sheet, TriangleIndex t, Point2 p);
  bool refine(Sheet& sheet, TriangleIndex t);
  bool split_segment(Sheet& sheet, HalfEdge h);
  void flip_round(Sheet& sheet, VertexIndex v);
  void note(const Sheet& sheet, TriangleIndex t);
  void note_changed(const Sheet& sheet);

  /// A triangle by its shortest edge.
  struct Entry {
    double squared_edge;
    TriangleIndex triangle;
    bool operator<(const Entry& other) const { return squared_edge > other.squared_edge; }
  };

  Options options_;
  PatchWork work_;
  ForcedWedges wedges_;
  LocalDelaunay delaunay_;
  std::vector<Entry> heap_;  // shortest first; each may be mended or changed by the time it is looked at
  std::vector<TriangleIndex> cavity_;
  StampedSet<TriangleIndex> met_;  // in the cavity
  std::vector<HalfEdge> encroached_;
  int recovered_ = 0;
  bool stopped_early_ = false;
};

}  // namespace cutbench
