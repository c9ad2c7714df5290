// Uniform grids: the nearest of many segments, and the triangle that holds a point.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "harness/measure/plane.h"

namespace cutbench::oracle {

/// Items (given by their bounding boxes) in square cells, at most about four cells an item.
class CellGrid {
 public:
  struct Box {
    Point low, high;
  };

  /// `cell` is the wished cell size (rest units); it grows until the cells are few enough.
  CellGrid(const std::vector<Box>& boxes, double cell);

  /// Calls visit(item) for the items of all cells that meet the box; an item of several cells comes several times.
  template <class Visit>
  void for_each_in(const Box& box, Visit visit) const {
    const auto [x0, y0] = cell_of(box.low);
    const auto [x1, y1] = cell_of(box.high);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) for_each_in_cell(x, y, visit);
  }

  /// Calls visit(item) for the cells in growing squares round p, until every item not yet visited is farther than the
  /// number visit returned last (a distance, infinity to go on).
  template <class Visit>
  void for_each_outwards(const Point& p, Visit visit) const {
    const auto [cx, cy] = cell_of(p);
    double enough = std::numeric_limits<double>::infinity();
    const auto note = [&](int item) { enough = visit(item); };
    for (int r = 0;; ++r) {
      for (int y = std::max(0, cy - r); y <= std::min(rows_ - 1, cy + r); ++y) {
        const bool whole_row = y == cy - r || y == cy + r;
        for (int x = cx - r; x <= cx + r; x += whole_row ? 1 : 2 * r)
          if (x >= 0 && x < columns_) for_each_in_cell(x, y, note);
      }
      if (clearance(p, cx, cy, r) >= enough) return;
    }
  }

 private:
  template <class Visit>
  void for_each_in_cell(int x, int y, Visit& visit) const {
    const int c = y * columns_ + x;
    for (int i = first_[c]; i < first_[c + 1]; ++i) visit(items_[i]);
  }

  /// The cell of a point; that nearest to it for a point outside the grid.
  std::pair<int, int> cell_of(const Point& p) const;

  /// Distance from p to the cells more than r away from cell (cx, cy), infinite where there are none.
  double clearance(const Point& p, int cx, int cy, int r) const;

  Point low_{0, 0};
  double cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<int> first_, items_;
};

class SegmentGrid {
 public:
  explicit SegmentGrid(std::vector<Segment> segments);

  /// To the nearest segment; infinite where there are none.
  double distance(const Point& p) const;

  /// Whether a segment lies on these (up to `tolerance`): judged at its ends and three points between.
  bool covers(const Segment& s, double tolerance) const;

  /// Calls visit(index) for the segments that may meet the box, perhaps repeatedly.
  template <class Visit>
  void for_each_in(const CellGrid::Box& box, Visit visit) const {
    grid_.for_each_in(box, visit);
  }

  const std::vector<Segment>& segments() const { return segments_; }

 private:
  std::vector<Segment> segments_;
  CellGrid grid_;
};

class TriangleGrid {
 public:
  /// Keeps a reference to the mesh.
  explicit TriangleGrid(const Mesh& mesh);

  /// Whether some triangle holds p, its boundary included. Exact.
  bool holds(const Point& p) const;

 private:
  const Mesh& mesh_;
  CellGrid grid_;
};

}  // namespace cutbench::oracle
