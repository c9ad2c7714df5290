// What lies across the seams of a sheet that is cut again and again.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "harness/mesh/seams.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

class SideGrid;

/// For each half-edge on a seam, that of the other side which lies at its middle.
class SeamEdges {
 public:
  SeamEdges() = default;
  explicit SeamEdges(const Sheet& sheet);  ///< cost: the whole sheet
  void update(const Sheet& sheet);         ///< after a cut; cost: what its log touched, and the seams there
  const std::map<HalfEdge, HalfEdge>& across() const { return across_; }
  /// The triangles on seams where the last call found something; some several times.
  const std::vector<TriangleIndex>& changed() const { return changed_; }

 private:
  void forget(TriangleIndex t);
  void add(const Sheet& sheet, TriangleIndex t);
  void join(std::size_t seam);
  void find_across(HalfEdge h);

  std::shared_ptr<const SideGrid> grid_;
  std::vector<std::vector<SewnEdge>> edges_;                    // per seam, as in sewn_edges()
  std::map<TriangleIndex, std::vector<std::size_t>> seams_at_;  // in rising order
  std::set<std::size_t> affected_;                              // seams
  std::map<HalfEdge, HalfEdge> across_;
  std::vector<TriangleIndex> changed_;
};

}  // namespace cutbench
