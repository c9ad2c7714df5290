#include "methods/tools/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "harness/base/conversions.h"
#include "methods/tools/creases.h"
#include "methods/tools/divided.h"

namespace cutbench {

namespace {

constexpr double worthwhile = 1.1;  // times as thick

/// One triangle, or several merged.
struct Cell {
  std::vector<TriangleIndex> triangles;
  std::vector<HalfEdge> outline;  ///< counter-clockwise
  std::vector<DeformedIndex> inside;
  double area = 0, perimeter = 0;
  double reference = 0;  ///< thickness of what it is a part of
  bool is_new = true;    ///< no polygon that was there before
  double thickness() const { return 4 * area / perimeter; }
};

class Merging {
 public:
  Merging(const Sheet& before, const Sheet& cut, const ThinParts& rules, const PolygonsLeft& left)
      : before_(before), sheet_(cut), rules_(rules), left_(left) {
    while (!before.triangle(parent_).alive()) ++parent_.value;
  }

  std::vector<Polygon> run(const std::vector<TriangleIndex>& parts) {
    take(parts);
    while (!thin_.empty()) {
      const auto [ratio, cell] = thin_.top();
      thin_.pop();
      // One that has grown since is on the list once more, where it is still thin.
      if (!cells_[cell].triangles.empty() && ratio == ratio_of(cells_[cell])) merge_with_a_neighbour(cell);
    }
    std::vector<Polygon> polygons;
    for (const Cell& cell : cells_)
      if (cell.triangles.size() > 1 && cell.is_new) polygons.push_back(polygon_of(cell));
    std::sort(polygons.begin(), polygons.end(),
              [](const Polygon& a, const Polygon& b) { return a.triangles.front() < b.triangles.front(); });
    return polygons;
  }

 private:
  struct Thin {
    double ratio;
    std::size_t cell;
    bool operator<(const Thin& other) const { return std::tie(other.ratio, other.cell) < std::tie(ratio, cell); }
  };

  void take(const std::vector<TriangleIndex>& parts) {
    for (const TriangleIndex t : parts)
      if (!cell_of_.contains(t())) add(t);
    const std::size_t first = cells_.size();
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (put_on_list(i) || i < first) find_neighbours(i);
  }

  static Cell triangle_cell(const Sheet& sheet, TriangleIndex t) {
    Cell cell;
    cell.triangles = {t};
    cell.outline = {half_edge(t, 0), half_edge(t, 1), half_edge(t, 2)};
    const auto c = sheet.corners(t);
    cell.area = std::max(0.0, cross(c[1] - c[0], c[2] - c[0]) / 2);
    for (std::size_t k = 0; k < 3; ++k) cell.perimeter += std::sqrt(squared_length(c[(k + 1) % 3] - c[k]));
    cell.reference = cell.thickness();
    return cell;
  }

  /// A triangle, or the polygon that was there before.
  std::size_t add(TriangleIndex t) {
    const auto members = left_.of ? left_.of(t) : std::span<const TriangleIndex>{};
    cells_.push_back(members.empty() ? part_cell(t) : polygon_cell(members));
    for (const TriangleIndex member : cells_.back().triangles) cell_of_[member()] = cells_.size() - 1;
    return cells_.size() - 1;
  }

  Cell part_cell(TriangleIndex t) {
    Cell cell = triangle_cell(sheet_, t);
    if (!is_part(before_, sheet_, t)) return cell;
    parent_ = parent_of(before_, sheet_, t, parent_);
    cell.reference = triangle_cell(before_, parent_).thickness();
    return cell;
  }

  Cell polygon_cell(std::span<const TriangleIndex> members) {
    Cell cell;
    cell.triangles.assign(members.begin(), members.end());
    cell.reference = std::numeric_limits<double>::infinity();
    cell.is_new = false;
    std::vector<HalfEdge> border;
    std::vector<DeformedIndex> corners;
    for (const TriangleIndex t : members) {
      const Cell part = part_cell(t);
      cell.area += part.area;
      cell.reference = std::min(cell.reference, part.reference);
      for (const HalfEdge h : part.outline) {
        corners.push_back(origin(h));
        if (sheet_.separates(h) ||
            !std::binary_search(members.begin(), members.end(), triangle_of(sheet_.opposite(h)))) {
          border.push_back(h);
          cell.perimeter += length(h);
        }
      }
    }
    const auto from = [&](DeformedIndex d) {
      return std::find_if(border.begin(), border.end(), [&](HalfEdge h) { return origin(h) == d; });
    };
    for (HalfEdge h = border.front(); cell.outline.size() < border.size(); h = *from(target(h)))
      cell.outline.push_back(h);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const DeformedIndex d : corners)
      if (from(d) == border.end()) cell.inside.push_back(d);
    return cell;
  }

  std::size_t cell_at(TriangleIndex t) {
    const auto found = cell_of_.find(t());
    return found != cell_of_.end() ? found->second : add(t);
  }

  static double ratio_of(const Cell& cell) { return cell.thickness() / cell.reference; }

  bool put_on_list(std::size_t cell) {
    const double ratio = ratio_of(cells_[cell]);
    if (ratio < rules_.thinness) thin_.push({ratio, cell});
    return ratio < rules_.thinness;
  }

  /// What other cuts made beside it: it may be thin, too.
  void find_neighbours(std::size_t cell) {
    const std::vector<HalfEdge> outline = cells_[cell].outline;
    for (const HalfEdge h : outline)
      if (!sheet_.separates(h))
        if (const TriangleIndex t = triangle_of(sheet_.opposite(h)); is_part(before_, sheet_, t)) cell_at(t);
  }

  /// They may have been left thin for want of one that is worth joining.
  void put_neighbours_on_list(std::size_t cell) {
    for (const HalfEdge h : cells_[cell].outline) {
      if (sheet_.separates(h)) continue;
      const auto found = cell_of_.find(triangle_of(sheet_.opposite(h))());
      if (found != cell_of_.end()) put_on_list(found->second);
    }
  }

  double length(HalfEdge h) const {
    return std::sqrt(squared_length(sheet_.rest(sheet_.target(h)) - sheet_.rest(sheet_.origin(h))));
  }
  DeformedIndex origin(HalfEdge h) const { return sheet_.triangle(triangle_of(h)).deformed[to_size(corner_of(h))]; }

  DeformedIndex target(HalfEdge h) const {
    return sheet_.triangle(triangle_of(h)).deformed[to_size(next_corner(corner_of(h)))];
  }

  void merge_with_a_neighbour(std::size_t thin) {
    std::vector<std::pair<double, HalfEdge>> ways;
    for (const HalfEdge h : cells_[thin].outline)
      if (!sheet_.separates(h) && !is_creased(sheet_, h)) ways.emplace_back(-length(h), h);
    std::sort(ways.begin(), ways.end());
    for (const auto& [minus_length, h] : ways) {
      const std::size_t other = cell_at(triangle_of(sheet_.opposite(h)));
      if (other == thin) continue;
      auto merged = merge(thin, other);
      if (!merged || !(merged->thickness() >= worthwhile * cells_[thin].thickness())) continue;
      for (const TriangleIndex t : cells_[other].triangles) cell_of_[t()] = thin;
      cells_[other] = {};
      cells_[thin] = std::move(*merged);
      put_on_list(thin);
      return put_neighbours_on_list(thin);
    }
  }

  /// The outline of a cell without what it shares with another one, from the end of that on; nothing unless that is
  /// one stretch. `shared` gets it.
  bool open_outline(const Cell& cell, std::size_t with, std::vector<HalfEdge>& rest, std::vector<HalfEdge>& shared) {
    const std::size_t n = cell.outline.size();
    const auto is_shared = [&](std::size_t i) {
      const HalfEdge h = cell.outline[i % n];
      if (sheet_.separates(h)) return false;
      const auto found = cell_of_.find(triangle_of(sheet_.opposite(h))());
      return found != cell_of_.end() && found->second == with;
    };
    std::size_t first = n, stretches = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (is_shared(i) && !is_shared(i + n - 1)) {
        first = i;
        ++stretches;
      }
    if (stretches != 1) return false;
    std::size_t i = first;
    for (; i < first + n && is_shared(i); ++i) shared.push_back(cell.outline[i % n]);
    for (; i < first + n; ++i) rest.push_back(cell.outline[i % n]);
    return true;
  }

  /// Nothing where it would be no polygon.
  std::optional<Cell> merge(std::size_t a, std::size_t b) {
    Cell merged;
    std::vector<HalfEdge> shared, shared_by_b;
    if (!open_outline(cells_[a], b, merged.outline, shared) || !open_outline(cells_[b], a, merged.outline, shared_by_b))
      return {};
    if (rules_.all_unknowns && shared.size() > 1) return {};
    std::vector<DeformedIndex> corners;
    for (const HalfEdge h : merged.outline) {
      corners.push_back(origin(h));
      merged.perimeter += length(h);
    }
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) return {};
    for (const std::size_t of : {a, b}) {
      const Cell& cell = cells_[of];
      merged.triangles.insert(merged.triangles.end(), cell.triangles.begin(), cell.triangles.end());
      merged.inside.insert(merged.inside.end(), cell.inside.begin(), cell.inside.end());
    }
    for (std::size_t i = 1; i < shared.size(); ++i) {
      merged.inside.push_back(origin(shared[i]));
      if (sheet_.is_held(sheet_.origin(shared[i]))) return {};
    }
    merged.area = cells_[a].area + cells_[b].area;
    merged.reference = std::min(cells_[a].reference, cells_[b].reference);
    return merged;
  }

  Polygon polygon_of(const Cell& cell) const {
    Polygon polygon{{}, cell.triangles, cell.inside};
    for (const HalfEdge h : cell.outline) polygon.corners.push_back(origin(h));
    auto& corners = polygon.corners;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::sort(polygon.triangles.begin(), polygon.triangles.end());
    std::sort(polygon.inside.begin(), polygon.inside.end());
    return polygon;
  }

  const Sheet &before_, &sheet_;
  ThinParts rules_;
  const PolygonsLeft& left_;
  TriangleIndex parent_{0};                               // of the last part
  std::vector<Cell> cells_;                               // those that were merged into others have no triangles
  std::unordered_map<std::size_t, std::size_t> cell_of_;  // per triangle near a cut
  std::priority_queue<Thin> thin_;                        // the thinnest on top
};

}  // namespace

std::vector<Polygon> merge_thin_parts(const Sheet& before, const Sheet& cut, const ThinParts& rules) {
  return Merging(before, cut, rules, {}).run(new_triangles(before, cut, true));
}

std::vector<Polygon> merge_new_thin_parts(const Sheet& before, const Sheet& cut, const ThinParts& rules,
                                          const PolygonsLeft& left) {
  std::vector<TriangleIndex> parts = last_new_triangles(before, cut);
  for (const TriangleIndex t : left.freed)
    if (cut.triangle(t).alive()) parts.push_back(t);
  return Merging(before, cut, rules, left).run(parts);
}

}  // namespace cutbench
