// Where a sheet's vertices are while it is cut, and how fast they go: as the motion says, or at rest where the sheet
// has them. A vertex that the cut made or moved has the weighted mean of those that it came from (EditLog::ancestry),
// which is what it gets after the cut, too. Cost: that of the cut, not of the sheet.
#pragma once

#include "harness/cut/motion.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

class DeformedState {
 public:
  /// \param motion  kept; null: at rest
  void see(const Motion* motion) { motion_ = motion; }
  /// To be called in each cut, before all else.
  void begin(const Sheet& sheet) {
    followed_ = 0;
    made_.clear(sheet.deformed_slots());
    follow(sheet);
  }
  /// After edits of the sheet: the vertices that its log names are known from here on.
  void follow(const Sheet& sheet);

  Point3 position(const Sheet& sheet, DeformedIndex d) const { return motion_ ? of(d).position : sheet.position(d); }
  Point3 velocity(DeformedIndex d) const { return motion_ ? of(d).velocity : Point3{}; }
  const Motion* motion() const { return motion_; }

 private:
  struct Vertex {
    Point3 position{}, velocity{};
  };
  Vertex of(DeformedIndex d) const;

  const Motion* motion_ = nullptr;
  StampedTable<DeformedIndex, Vertex> made_;  // by the cut under way
  std::size_t followed_ = 0;                  // entries of the log
};

}  // namespace cutbench
