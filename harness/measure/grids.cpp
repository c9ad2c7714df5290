#include "harness/measure/grids.h"

#include <numeric>

#include "harness/measure/exact.h"

namespace cutbench::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void extend(CellGrid::Box& box, const Point& p) {
  for (int i : {0, 1}) {
    box.low[i] = std::min(box.low[i], p[i]);
    box.high[i] = std::max(box.high[i], p[i]);
  }
}

std::vector<CellGrid::Box> boxes(const std::vector<Segment>& segments) {
  std::vector<CellGrid::Box> result;
  for (const auto& [a, b] : segments) extend(result.emplace_back(CellGrid::Box{a, a}), b);
  return result;
}

std::vector<CellGrid::Box> boxes(const Mesh& mesh) {
  std::vector<CellGrid::Box> result;
  for (const auto& [a, b, c] : mesh.triangles) {
    CellGrid::Box& box = result.emplace_back(CellGrid::Box{mesh.rest[a], mesh.rest[a]});
    extend(box, mesh.rest[b]);
    extend(box, mesh.rest[c]);
  }
  return result;
}

/// Mean larger side of the boxes.
double mean_size(const std::vector<CellGrid::Box>& boxes) {
  double sum = 0;
  for (const auto& [low, high] : boxes) sum += std::max(high[0] - low[0], high[1] - low[1]);
  return boxes.empty() ? 1 : sum / static_cast<double>(boxes.size());
}

}  // namespace

CellGrid::CellGrid(const std::vector<Box>& boxes, double cell) {
  Box all = boxes.empty() ? Box{{0, 0}, {1, 1}} : boxes.front();
  for (const auto& [low, high] : boxes) extend(all, low), extend(all, high);
  low_ = all.low;
  const double width = all.high[0] - all.low[0], height = all.high[1] - all.low[1];
  const double wanted = 4.0 * static_cast<double>(boxes.size()) + 16;
  cell_ = std::max({cell, width / wanted, height / wanted, std::numeric_limits<double>::min()});
  while ((width / cell_ + 1) * (height / cell_ + 1) > wanted) cell_ *= 1.25;
  columns_ = static_cast<int>(width / cell_) + 1;
  rows_ = static_cast<int>(height / cell_) + 1;

  const auto for_each_cell = [&](const Box& box, auto visit) {
    const auto [x0, y0] = cell_of(box.low);
    const auto [x1, y1] = cell_of(box.high);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) visit(y * columns_ + x);
  };
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const Box& box : boxes) for_each_cell(box, [&](int c) { ++first_[c + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.resize(first_.back());
  std::vector<int> end(first_);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for_each_cell(boxes[i], [&](int c) { items_[end[c]++] = static_cast<int>(i); });
}

std::pair<int, int> CellGrid::cell_of(const Point& p) const {
  const auto index = [this](double x, int count) {
    return static_cast<int>(std::clamp(std::floor(x / cell_), 0.0, static_cast<double>(count - 1)));
  };
  return {index(p[0] - low_[0], columns_), index(p[1] - low_[1], rows_)};
}

double CellGrid::clearance(const Point& p, int cx, int cy, int r) const {
  double result = infinity;
  if (cx - r > 0) result = std::min(result, p[0] - (low_[0] + (cx - r) * cell_));
  if (cx + r < columns_ - 1) result = std::min(result, low_[0] + (cx + r + 1) * cell_ - p[0]);
  if (cy - r > 0) result = std::min(result, p[1] - (low_[1] + (cy - r) * cell_));
  if (cy + r < rows_ - 1) result = std::min(result, low_[1] + (cy + r + 1) * cell_ - p[1]);
  return result;
}

SegmentGrid::SegmentGrid(std::vector<Segment> segments)
    : segments_(std::move(segments)), grid_(boxes(segments_), mean_size(boxes(segments_))) {}

double SegmentGrid::distance(const Point& p) const {
  double nearest = infinity;
  grid_.for_each_outwards(p, [&](int i) {
    const Point there = oracle::nearest(p, segments_[i]);
    // hypot() is most of the time, and seldom needed to see that this one is farther.
    if (std::max(std::abs(there[0] - p[0]), std::abs(there[1] - p[1])) < nearest)
      nearest = std::min(nearest, oracle::distance(p, there));
    return nearest;
  });
  return nearest;
}

bool SegmentGrid::covers(const Segment& s, double tolerance) const {
  bool same = false;  // as most are: where a cut did not come, edges stay what they are
  grid_.for_each_in({s[0], s[0]},
                    [&](int i) { same |= segments_[i] == s || (segments_[i][0] == s[1] && segments_[i][1] == s[0]); });
  if (same) return true;
  for (double t : {0.0, 0.25, 0.5, 0.75, 1.0})
    if (!(distance(between(s[0], s[1], t)) <= tolerance)) return false;
  return true;
}

TriangleGrid::TriangleGrid(const Mesh& mesh) : mesh_(mesh), grid_(boxes(mesh), mean_size(boxes(mesh))) {}

bool TriangleGrid::holds(const Point& p) const {
  bool found = false;
  grid_.for_each_in({p, p}, [&](int t) {
    if (found) return;
    const auto& [i, j, k] = mesh_.triangles[t];
    const Point &a = mesh_.rest[i], &b = mesh_.rest[j], &c = mesh_.rest[k];
    found = orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
  });
  return found;
}

}  // namespace cutbench::oracle
