#include "harness/mesh/seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/seam_edges.h"
#include "harness/mesh/seam_pairs.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Squares that hold the sides of seams, to find those near a point. A square is as wide as the longest side.
class SideGrid {
 public:
  struct Side {
    std::size_t seam;
    bool first;
  };

  explicit SideGrid(std::span<const Seam> seams) {
    for (const Seam& seam : seams)
      for (const auto& [a, b] : {seam.first, seam.second}) width_ = std::max(width_, length(b - a));
    for (std::size_t i = 0; i < seams.size(); ++i)
      for (const bool first : {true, false}) {
        const auto& [a, b] = first ? seams[i].first : seams[i].second;
        squares_[square_of(0.5 * (a + b))].push_back({i, first});
      }
  }

  /// Calls visit(side) for all whose middle is less than a width from p.
  template <class Visit>
  void for_each_near(Point2 p, const Visit& visit) const {
    const auto [x, y] = square_of(p);
    for (std::int64_t i = x - 1; i <= x + 1; ++i)
      for (std::int64_t k = y - 1; k <= y + 1; ++k)
        if (const auto found = squares_.find({i, k}); found != squares_.end())
          for (const Side& side : found->second) visit(side);
  }

 private:
  using Square = std::pair<std::int64_t, std::int64_t>;
  Square square_of(Point2 p) const { return {to_int64(std::floor(p.x / width_)), to_int64(std::floor(p.y / width_))}; }

  double width_ = 0;
  std::map<Square, std::vector<Side>> squares_;
};

namespace {

/// A point of the border that a seam may have: how far along, and whether on it.
struct AlongSeam {
  double place;
  bool on;
};

AlongSeam along(const std::array<Point2, 2>& side, Point2 p) {
  const Point2 way = side[1] - side[0], to = p - side[0];
  const double square = squared_length(way), place = dot(way, to) / square;
  const bool near = std::abs(cross(way, to)) <= seam_rounding * square;
  return {place, near && place >= -seam_rounding && place <= 1 + seam_rounding};
}

template <class Visit>
void for_each_sewn(const Sheet& sheet, const SideGrid& grid, TriangleIndex t, const Visit& visit) {
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (!sheet.on_border(h)) continue;
    const Point2 from = sheet.rest(sheet.origin(h)), to = sheet.rest(sheet.target(h));
    grid.for_each_near(0.5 * (from + to), [&](const SideGrid::Side& side) {
      const Seam& seam = sheet.seams()[side.seam];
      const auto& line = side.first ? seam.first : seam.second;
      const AlongSeam a = along(line, from), b = along(line, to);
      if (a.on && b.on) visit(SewnEdge{h, side.seam, side.first, a.place, b.place});
    });
  }
}

bool comes_before(const SewnEdge& a, const SewnEdge& b) {
  if (a.seam != b.seam) return a.seam < b.seam;
  return a.first != b.first ? a.first : a.low() < b.low();
}

}  // namespace

std::vector<SewnEdge> sewn_edges(const Sheet& sheet) {
  std::vector<SewnEdge> edges;
  if (sheet.seams().empty()) return edges;
  const SideGrid grid(sheet.seams());
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    if (const TriangleIndex t(i); sheet.triangle(t).alive())
      for_each_sewn(sheet, grid, t, [&](const SewnEdge& edge) { edges.push_back(edge); });
  std::sort(edges.begin(), edges.end(), comes_before);
  return edges;
}

SeamEdges::SeamEdges(const Sheet& sheet) : edges_(sheet.seams().size()) {
  if (edges_.empty()) return;
  grid_ = std::make_shared<const SideGrid>(sheet.seams());
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    if (const TriangleIndex t(i); sheet.triangle(t).alive()) add(sheet, t);
  for (const std::size_t seam : affected_) join(seam);
}

void SeamEdges::update(const Sheet& sheet) {
  changed_.clear();
  affected_.clear();
  if (edges_.empty()) return;
  const auto look_again = [&](TriangleIndex t) {
    forget(t);
    if (sheet.triangle(t).alive()) add(sheet, t);
  };
  for (const auto& touched : sheet.log().touched) look_again(touched.slot);
  for (std::size_t t = sheet.log().triangles_before; t < sheet.triangle_slots(); ++t) look_again(TriangleIndex(t));
  for (const std::size_t seam : affected_) join(seam);
}

void SeamEdges::forget(TriangleIndex t) {
  const auto found = seams_at_.find(t);
  if (found == seams_at_.end()) return;
  for (const std::size_t seam : found->second) {
    std::erase_if(edges_[seam], [t](const SewnEdge& edge) { return triangle_of(edge.edge) == t; });
    affected_.insert(seam);
  }
  for (int k = 0; k < 3; ++k) across_.erase(half_edge(t, k));
  seams_at_.erase(found);
}

void SeamEdges::add(const Sheet& sheet, TriangleIndex t) {
  for_each_sewn(sheet, *grid_, t, [&](const SewnEdge& edge) {
    edges_[edge.seam].push_back(edge);
    std::vector<std::size_t>& seams = seams_at_[t];
    const auto place = std::lower_bound(seams.begin(), seams.end(), edge.seam);
    if (place == seams.end() || *place != edge.seam) seams.insert(place, edge.seam);
    affected_.insert(edge.seam);
  });
}

void SeamEdges::join(std::size_t seam) {
  std::sort(edges_[seam].begin(), edges_[seam].end(), comes_before);
  for (const SewnEdge& edge : edges_[seam]) {
    find_across(edge.edge);
    changed_.push_back(triangle_of(edge.edge));
  }
}

void SeamEdges::find_across(HalfEdge h) {
  across_.erase(h);
  for (const std::size_t seam : seams_at_.at(triangle_of(h)))
    for (const SewnEdge& a : edges_[seam]) {
      if (a.edge != h) continue;
      const double middle = 0.5 * (a.begin + a.end);
      for (const SewnEdge& b : edges_[seam])
        if (share_more_than_a_point(a, b) && b.low() <= middle && middle <= b.high()) across_.try_emplace(h, b.edge);
    }
}

std::size_t count_pieces(const Sheet& sheet) {
  UnionFind pieces(sheet.triangle_slots());
  std::size_t count = sheet.triangle_count();
  const auto join = [&](TriangleIndex a, TriangleIndex b) {
    if (pieces.find(a()) == pieces.find(b())) return;
    pieces.join(a(), b());
    --count;
  };
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(t, k); !sheet.separates(h)) join(t, triangle_of(sheet.opposite(h)));
  }
  const std::vector<SewnEdge> edges = sewn_edges(sheet);
  for_each_pair(edges, [&](const SewnEdge& a, const SewnEdge& b) { join(triangle_of(a.edge), triangle_of(b.edge)); });
  return count;
}

}  // namespace cutbench
