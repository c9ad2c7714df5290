// Point location: a triangle near a point, to walk on from, and the border edges near a segment outside the sheet. A
// grid of cells over the rest bounding box; each cell holds one triangle and the border edges near it. Updated from the
// edit log.
#pragma once

#include <optional>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

class Locator {
 public:
  Locator() = default;
  /// Cost: the whole mesh, once.
  explicit Locator(const Sheet& sheet);
  /// Takes in what the last cut changed. Cost: the triangles it changed.
  void update(const Sheet& sheet);

  /// A triangle of the sheet that is near p in most cases; the caller walks on from there.
  TriangleIndex near(const Sheet& sheet, Point2 p) const;

  /// Calls visit(half-edge) for border half-edges, cell by cell along the segment a -> b from its start, until visit
  /// returns true after a cell is done: `done(s)` is asked with the fraction s of the segment that is covered.
  /// Every border edge that the segment meets is visited before its fraction is covered; others, and repeats, come too.
  template <class Visit, class Done>
  void visit_border(const Sheet& sheet, Point2 a, Point2 b, Visit visit, Done done) const;

 private:
  struct BorderEntry {
    HalfEdge half_edge;
    std::int32_t next = -1;
  };
  int column(double x) const { return clamp_cell((x - low_.x) * per_cell_.x, columns_); }
  int row(double y) const { return clamp_cell((y - low_.y) * per_cell_.y, rows_); }
  static int clamp_cell(double c, int n) { return c <= 0 ? 0 : c >= n - 1 ? n - 1 : to_int(c); }
  std::size_t cell(int column, int row) const { return to_size(row) * to_size(columns_) + to_size(column); }
  void add_border(const Sheet& sheet, HalfEdge h);

  int columns_ = 0, rows_ = 0;
  Point2 low_, high_, per_cell_;
  std::vector<TriangleIndex> triangle_;  // per cell
  std::vector<std::int32_t> border_;     // per cell: first entry
  std::vector<BorderEntry> entries_;
};

template <class Visit, class Done>
void Locator::visit_border(const Sheet& sheet, Point2 a, Point2 b, Visit visit, Done done) const {
  // Column by column in the direction of the segment; one cell more on every side absorbs rounding, and each column is
  // a little wider than its cells, for a segment that runs along their side.
  const double margin = meeting_tolerance * sheet.snap();
  const double dx = b.x - a.x;
  const int first = column(a.x), last = column(b.x), step = dx >= 0 ? 1 : -1;
  auto fraction = [&](double x) { return std::min(1.0, std::max(0.0, (x - a.x) / dx)); };
  for (int c = first - step; c != last + 2 * step; c += step) {
    if (c < 0 || c >= columns_) continue;
    const double left = low_.x + c / per_cell_.x, right = low_.x + (c + 1) / per_cell_.x;
    // The outermost columns stand for everything beyond them.
    const bool is_first = dx == 0 || c == (step > 0 ? 0 : columns_ - 1);
    const bool is_last = dx == 0 || c == (step > 0 ? columns_ - 1 : 0);
    const double s0 = is_first ? 0 : fraction(step > 0 ? left - margin : right + margin);
    const double s1 = is_last ? 1 : fraction(step > 0 ? right + margin : left - margin);
    const double y0 = a.y + s0 * (b.y - a.y), y1 = a.y + s1 * (b.y - a.y);
    const int bottom = std::max(0, row(std::min(y0, y1)) - 1), top = std::min(rows_ - 1, row(std::max(y0, y1)) + 1);
    for (int r = bottom; r <= top; ++r)
      for (std::int32_t e = border_[cell(c, r)]; e >= 0; e = entries_[to_size(e)].next) {
        const HalfEdge h = entries_[to_size(e)].half_edge;
        if (triangle_of(h)() < sheet.triangle_slots() && sheet.triangle(triangle_of(h)).alive() && sheet.on_border(h))
          visit(h);
      }
    const double covered = is_last ? 1 : fraction(step > 0 ? right - margin : left + margin);
    if (dx != 0 && c != first - step && done(covered)) return;
  }
}

/// The triangle that holds p, by a walk from `start`; p lies inside the sheet, clear of its edges but for rounding.
/// Where that takes it past the border, the last triangle before it.
TriangleIndex triangle_at(const Sheet& sheet, TriangleIndex start, Point2 p);

}  // namespace cutbench
