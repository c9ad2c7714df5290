// Lawson's flips, kept to where a cut has been: edges are turned until they are Delaunay, as far as incisions let them,
// round the vertices that the cut made or moved.
//
// An edge is flipped where the far corner of one of its triangles lies strictly inside the circumcircle of the other
// (exact; constraints stay as they are), and the four edges round the two triangles are looked at next (Lawson,
// Software for C1 surface interpolation, 1977). Each flip lowers the triangulation lifted onto the paraboloid, so that
// it ends. Border and marked edges stay: what comes of it is constrained Delaunay where the input was Delaunay. Edges
// between four vertices of the sheet before the cut stay, too: without that rule, a cut of a sheet that is not Delaunay
// would flip its way through all of it.
#pragma once

#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

/// Keeps its working storage from one cut to the next.
class LocalDelaunay {
 public:
  /// Forgets what was added. \pre the sheet's begin_cut() was called; its log tells which vertices are new or moved.
  void begin(const Sheet& sheet);
  /// Asks for the three edges of t to be looked at.
  void add(TriangleIndex t);
  /// Flips until nothing that was added, or put in doubt by a flip, is left to flip.
  void run(Sheet& sheet);

  /// Triangles changed by run(), some more than once, since the caller last cleared it.
  std::vector<TriangleIndex> changed;

 private:
  void note_vertices(const Sheet& sheet);

  std::vector<HalfEdge> open_;
  StampedSet<VertexIndex> noted_;     // made or moved by the cut under way
  std::size_t made_ = 0, moved_ = 0;  // entries of the log noted already
};

}  // namespace cutbench
