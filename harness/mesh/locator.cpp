#include "harness/mesh/locator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

Locator::Locator(const Sheet& sheet) {
  low_ = {1e300, 1e300};
  high_ = {-1e300, -1e300};
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) {
    if (!sheet.triangle_of_vertex(VertexIndex(v)).valid()) continue;
    const Point2 p = sheet.rest(VertexIndex(v));
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  // About two triangles per cell, cells about square.
  const Point2 extent{high_.x - low_.x, high_.y - low_.y};
  const double cells = std::max(1.0, to_double(sheet.triangle_count()) / 2);
  const double ratio = std::clamp(extent.x / extent.y, 1 / cells, cells);
  columns_ = std::max(1, to_int(std::sqrt(cells * ratio)));
  rows_ = std::max(1, to_int(cells / columns_));
  per_cell_ = {columns_ / extent.x, rows_ / extent.y};
  triangle_.resize(cell(0, rows_));
  border_.assign(cell(0, rows_), -1);
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    const auto p = sheet.corners(t);
    triangle_[cell(column((p[0].x + p[1].x + p[2].x) / 3), row((p[0].y + p[1].y + p[2].y) / 3))] = t;
    for (int k = 0; k < 3; ++k)
      if (sheet.on_border(half_edge(t, k))) add_border(sheet, half_edge(t, k));
  }

  // Cells without a triangle's centre take over their neighbours' triangles, ring by ring.
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < triangle_.size(); ++i)
    if (triangle_[i].valid()) front.push_back(i);
  for (std::size_t i = 0; i < front.size(); ++i) {
    const int c = to_int(front[i]) % columns_, r = to_int(front[i]) / columns_;
    for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (c + dc < 0 || c + dc >= columns_ || r + dr < 0 || r + dr >= rows_) continue;
      const std::size_t other = cell(c + dc, r + dr);
      if (triangle_[other].valid()) continue;
      triangle_[other] = triangle_[front[i]];
      front.push_back(other);
    }
  }
}

void Locator::add_border(const Sheet& sheet, HalfEdge h) {
  const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
  for (int r = row(std::min(a.y, b.y)); r <= row(std::max(a.y, b.y)); ++r)
    for (int c = column(std::min(a.x, b.x)); c <= column(std::max(a.x, b.x)); ++c) {
      entries_.push_back({h, border_[cell(c, r)]});
      border_[cell(c, r)] = to_int32(entries_.size() - 1);
    }
}

void Locator::update(const Sheet& sheet) {
  // A cell's triangle needs no update: the first child of a triangle keeps its slot, so what is there is still near.
  // Nor does a border edge that stayed the same half-edge; entries of others remain, as few as border edges ever made.
  if (2 * sheet.log().touched.size() > sheet.triangle_count()) {  // a new one costs no more, and forgets old entries
    *this = Locator(sheet);
    return;
  }
  const bool in_place = sheet.log().moved.empty();
  const auto add = [&](TriangleIndex t, const Triangle& before) {
    const Triangle& triangle = sheet.triangle(t);
    if (!triangle.alive()) return;
    for (int k = 0; k < 3; ++k) {
      const auto i = to_size(k), j = to_size(next_corner(k));
      const bool same = in_place && before.alive() && !before.opposite[i].valid() &&
                        before.vertex[i] == triangle.vertex[i] && before.vertex[j] == triangle.vertex[j];
      if (!triangle.opposite[i].valid() && !same) add_border(sheet, half_edge(t, k));
    }
  };
  for (const auto& entry : sheet.log().touched) add(entry.slot, entry.before);
  for (std::size_t t = sheet.log().triangles_before; t < sheet.triangle_slots(); ++t) add(TriangleIndex(t), Triangle());
}

TriangleIndex Locator::near(const Sheet& sheet, Point2 p) const {
  const TriangleIndex t = triangle_[cell(column(p.x), row(p.y))];
  if (t() < sheet.triangle_slots() && sheet.triangle(t).alive()) return t;
  std::size_t other = 0;  // the cell's triangle was collapsed away: any other will do
  while (!sheet.triangle(TriangleIndex(other)).alive()) ++other;
  return TriangleIndex(other);
}

TriangleIndex triangle_at(const Sheet& sheet, TriangleIndex start, Point2 p) {
  const auto step = [&](TriangleIndex t) {  // itself where it holds p, invalid beyond the border
    const auto c = sheet.corners(t);
    for (int k = 0; k < 3; ++k)
      if (const auto i = to_size(k); orientation(c[i], c[(i + 1) % 3], p) < 0) {
        const HalfEdge o = sheet.opposite(half_edge(t, k));
        return o.valid() ? triangle_of(o) : TriangleIndex();
      }
    return t;
  };
  TriangleIndex last, t = start;
  for (std::size_t i = 0; t.valid() && i < sheet.triangle_slots(); ++i) {
    const TriangleIndex next = step(t);
    if (next == t) return t;
    last = std::exchange(t, next);
  }
  // Past a notch of the border.
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    if (sheet.triangle(TriangleIndex(i)).alive() && step(TriangleIndex(i)) == TriangleIndex(i)) return TriangleIndex(i);
  return last;
}

}  // namespace cutbench
