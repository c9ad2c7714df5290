// How far the opened edges are from the requested curve, and the curve from the opened edges.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"
#include "harness/oracle/search.h"

namespace cutbench::oracle {

/// The two one-sided Hausdorff distances of the incision error (docs/explanation/measuring.md), rest units.
struct IncisionError {
  double of_path = 0;   ///< from the part of the path inside the sheet to the nearest opened edge
  double of_edges = 0;  ///< from the new opened edges to the path; infinite where there is no path at all
};

/// Both distances by sampling, so each may be short by what happens between two samples; a path segment's or edge's end
/// points are always sampled.
/// @param asked    flattened requested curves that must be opened
/// @param path     all requested ones, along which edges may be opened
/// @param edges    all opened edges of the result, older incisions and the border included: where the path runs along
///                 those there was nothing to do
/// @param added    the new opened edges, one per pair of lips
/// @param sheet    the sheet before the cut: the path outside does not count
/// @param spacing  largest distance of two samples, rest units, > 0
IncisionError incision_error(const std::vector<Segment>& asked, const SegmentSearch& path, const SegmentSearch& edges,
                             const std::vector<Segment>& added, const TriangleSearch& sheet, double spacing);

}  // namespace cutbench::oracle
