// Seams: where a sheet hangs together in space, but not at rest, as the panels of a garment do.
//
// A sheet is open along its seams, since a `v` with several `vt` becomes several vertices. A curve between two points is
// straight at rest, and may lead through whatever lies between two panels there: such a curve is looked for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// A place of the sheet.
struct PlaceAtRest {
  TriangleIndex triangle;
  Point2 point;  ///< in it
};

/// The seams of one moment: vertices that are at bit-equal positions in space, and at different ones at rest. The lips
/// of an incision are none. Cost: the whole mesh, once.
class Seams {
 public:
  explicit Seams(const Sheet& posed);

  /// The two places lie on panels that are sewn together, or on one panel that is sewn to itself so that the way over
  /// the seam is shorter than the straight line at rest. The way is measured along edges, which is too long by some
  /// per cent (by 41 % at most on a grid of right triangles): a seam may be missed where the two differ by less.
  bool lies_between(const PlaceAtRest& a, const PlaceAtRest& b) const;

 private:
  struct Way {
    std::size_t to;
    double length;  // at rest
  };
  double shortest_way(const PlaceAtRest& a, const PlaceAtRest& b) const;

  // Empty where there is no seam.
  std::vector<std::array<std::size_t, 3>> vertices_;  // per triangle
  std::vector<std::array<Point2, 3>> corners_;        // likewise, at rest
  std::vector<std::vector<Way>> ways_;                // per deformed vertex
  std::vector<std::size_t> panel_, sewn_panels_;      // per deformed vertex
};

}  // namespace cutbench
