// A part of the sheet meshed anew by CGAL's Delaunay mesh generator: the region's border, older incisions and the path
// are constraints, which it may divide, but never the region's border to the rest of the sheet.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "harness/mesh/sheet.h"
#include "methods/tools/forced_wedges.h"
#include "methods/tools/region.h"

namespace cutbench {

/// Keeps its working storage from one use to the next. The four steps are called one after the other, refine() also
/// where it is to add nothing.
class RegionMesher {
 public:
  RegionMesher();
  ~RegionMesher();

  struct Limits {
    double max_aspect = 3;                                      ///< a triangle beyond it is divided
    double max_edge = std::numeric_limits<double>::infinity();  ///< and one with a longer edge, rest units
    double min_edge = 0;                                        ///< but none whose edges are all shorter
    std::size_t most_vertices = 0;                              ///< made; then it stops where it is; 0 refines nothing
    const ForcedWedges* wedges = nullptr;                       ///< triangles there are left alone
  };

  /// 1. Reads the triangles of the region: constraints, and vertices, of which those on no constraint and not held
  /// (Sheet::hold) may be left out. The region must live, and stay as it is, until the last step.
  void convert(const Sheet& sheet, const Region& region, bool with_inner_vertices);
  /// 2. The constrained Delaunay triangulation of what was read. False: too close together for doubles,
  /// or two vertices at one place; then there is nothing to go on with.
  bool insert(const Sheet& sheet);
  /// 3. CGAL's Delaunay_mesher_2, until no triangle asks for more. False where it met the limit of vertices, or doubles
  /// were too coarse.
  bool refine(const Sheet& sheet, const Limits& limits);
  /// Edges between the region and the rest of the sheet that the refinement divided: with any, it can't be put back.
  const std::vector<HalfEdge>& divided() const;
  /// 4. Puts the new triangles in the place of the region's. New vertices lie where they lay in the old triangles, and
  /// vertices that were left out are freed. False, and the sheet unchanged: doubles were too coarse.
  /// \pre divided().empty()
  bool put_back(Sheet& sheet);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace cutbench
