// Readings of the local split of Xin et al. 2018, 4.1.3, other than the literal one of bowyer_watson.h: to show that
// the finding about its bound does not rest on that one. Variants, no rows of the table.
//
//  - grouped: every ill-shaped triangle of a round gets its two midpoints first. Then all that lies in one triangle
//    of the sheet before the cut is made Delaunay again, with the path kept;
//  - region: the two midpoints, then Bowyer-Watson over all that the cut changed, with the path kept (by Lawson's
//    flips, which end with the same triangulation, harness/mesh/local_delaunay.h), triangle after triangle;
//  - longest_edge: the same with the midpoint of the longest edge alone.
//
// Open lips, each split on its own, are no variant: a closed path has the same vertices on both sides. What bounds the
// literal reading lies inside a single triangle, so that it holds for them, too.
// Promises: as bowyer_watson.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/mesh/local_delaunay.h"
#include "harness/mesh/stamped_table.h"
#include "methods/bowyer_watson/bowyer_watson.h"

namespace cutbench {

class SplitReading : public BowyerWatson {
 public:
  enum class Reading : std::uint8_t { grouped, region, longest_edge };
  SplitReading(Reading reading, const Options& options) : BowyerWatson(options), reading_(reading), options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes& notes) override;

 private:
  bool is_ill_shaped(const Sheet& sheet, TriangleIndex t) const;
  void split_edges_of(Sheet& sheet, TriangleIndex t);
  void split(Sheet& sheet, HalfEdge h);
  void find_groups(const Sheet& sheet);
  void flip_within_groups(Sheet& sheet);

  Reading reading_;
  Options options_;
  LocalDelaunay delaunay_;
  std::vector<TriangleIndex> ill_shaped_;
  std::vector<HalfEdge> open_;
  std::vector<std::array<Point2, 3>> crossed_;  // corners of the triangles that the path crosses
  StampedTable<TriangleIndex, int> group_;      // the number of the crossed triangle that it lies in; none outside
};

}  // namespace cutbench
