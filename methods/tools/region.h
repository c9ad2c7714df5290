// A part of the sheet: some of its triangles, in the order in which they were added.
#pragma once

#include <span>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/mesh/stamped_table.h"

namespace cutbench {

/// Keeps its working storage from one use to the next. What it does costs its size, not the sheet's.
class Region {
 public:
  /// Empties it. The sheet must stay as it is until the next clear().
  void clear(const Sheet& sheet);
  /// Without effect where t is in it.
  void add(TriangleIndex t);
  /// Adds the triangles that the cut under way has made or changed.
  void add_changed(const Sheet& sheet);
  /// Adds `rings` of neighbours, and then whatever else lies across an edge whose diametral circle holds a corner of
  /// one of its triangles, since a mesh generator would divide such an edge at once.
  void grow(const Sheet& sheet, int rings);

  std::span<const TriangleIndex> triangles() const { return triangles_; }
  bool holds(TriangleIndex t) const { return place_.holds(t); }
  /// Where t is in triangles(); -1 where it isn't.
  int place_of(TriangleIndex t) const { return place_.get(t, -1); }

 private:
  std::vector<TriangleIndex> triangles_;
  StampedTable<TriangleIndex, int> place_;
};

}  // namespace cutbench
