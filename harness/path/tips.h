// Where a path ends: in the sheet, or on an edge that is open already.
#pragma once

#include <algorithm>
#include <cmath>

#include "harness/mesh/sheet.h"

namespace cutbench {

/// Is an edge of the border a part of a seam? Cost: all seams; for tips, of which a path has two.
inline bool is_on_seam(const Sheet& sheet, HalfEdge h) {
  const Point2 ends[] = {sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h))};
  const auto lies_on = [&](const std::array<Point2, 2>& side) {
    const Point2 way = side[1] - side[0];
    const double near = seam_rounding * squared_length(way);
    return std::all_of(std::begin(ends), std::end(ends), [&](Point2 p) {
      const double along = dot(way, p - side[0]);
      return std::abs(cross(way, p - side[0])) <= near && along >= -near && along <= squared_length(way) + near;
    });
  };
  return std::any_of(sheet.seams().begin(), sheet.seams().end(),
                     [&](const Seam& seam) { return lies_on(seam.first) || lies_on(seam.second); });
}

/// Is the edge open for a path that ends on it? A seam is, but only for a path that goes on beyond it: in space it is
/// no border.
inline bool is_open(const Sheet& sheet, HalfEdge h, bool goes_on) {
  return sheet.separates(h) && (goes_on || !sheet.on_border(h) || !is_on_seam(sheet, h));
}

}  // namespace cutbench
