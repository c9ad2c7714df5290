// The edges that cuts opened: which cut opened each, and which of its sides is the left one, as seen along the path.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// An edge of an incision, along the path. Where a method took the triangles of a side out of the sheet, that side is
/// invalid, and the other one lies on the border.
struct IncisionEdge {
  std::size_t cut;       ///< its number, from 0
  HalfEdge left, right;  ///< of the triangle on this side of the path, which lies to the left of its half-edge
};

/// Watches a sheet that is cut several times.
class Incisions {
 public:
  /// \param before  what is open in it belongs to no cut
  explicit Incisions(const Sheet& before);
  /// After each cut that changed the sheet. Looks at the whole sheet.
  void add(const Sheet& sheet, std::size_t cut);
  /// Of the sheet as it was added last, cut by cut from the beginning of each. \param cuts  all of them
  std::vector<IncisionEdge> edges(const Sheet& sheet, std::span<const Curve> cuts) const;

 private:
  struct Open {
    Point2 from, to;
    std::ptrdiff_t cut;  ///< -1: none
  };
  using Ends = std::pair<VertexIndex, VertexIndex>;
  std::ptrdiff_t cut_of(const Sheet& sheet, HalfEdge h) const;

  std::map<Ends, Open> open_;  ///< per half-edge that separates
};

}  // namespace cutbench
