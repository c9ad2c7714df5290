#include "harness/mesh/seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/seam_edges.h"
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

DeformedIndex deformed_at(const Sheet& sheet, HalfEdge h) {
  return sheet.triangle(triangle_of(h)).deformed[to_size(corner_of(h))];
}

/// Deformed vertices at the two ends of a sewn edge, from 0 to 1 along the seam.
std::array<DeformedIndex, 2> ends_of(const Sheet& sheet, const SewnEdge& edge) {
  const DeformedIndex from = deformed_at(sheet, edge.edge), to = deformed_at(sheet, Sheet::next(edge.edge));
  return edge.begin < edge.end ? std::array{from, to} : std::array{to, from};
}

/// Of one seam, on both its sides.
bool share_more_than_a_point(const SewnEdge& a, const SewnEdge& b) {
  return a.first != b.first && std::min(a.high(), b.high()) - std::max(a.low(), b.low()) > seam_rounding;
}

/// Calls visit(a, b) for each pair of edges on the two sides of a seam that share more than a point.
template <class Visit>
void for_each_pair(std::span<const SewnEdge> edges, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].seam == edges[begin].seam) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = i + 1; k < end; ++k)
        if (share_more_than_a_point(edges[i], edges[k])) visit(edges[i], edges[k]);
  }
}

bool equal(double a, double b) { return std::abs(a - b) <= seam_rounding; }

/// A vertex of the second side between the ends of an edge of the first one.
struct Hanging {
  DeformedIndex vertex;
  std::array<DeformedIndex, 2> masters;
  double weight;  ///< of the second
};

}  // namespace

std::vector<Seam> seams_of(const MeshData& mesh) {
  std::vector<Seam> seams;
  if (mesh.sewn.empty()) return seams;
  using Edge = std::pair<std::int32_t, std::int32_t>;
  std::map<Edge, int> uses;
  const auto sorted = [](std::int32_t a, std::int32_t b) { return Edge(std::min(a, b), std::max(a, b)); };
  const auto for_each_edge = [&](const auto& act) {
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) act(t[k], t[(k + 1) % 3]);
  };
  for_each_edge([&](std::int32_t a, std::int32_t b) { ++uses[sorted(a, b)]; });
  std::map<Edge, Edge> first_of;  // by the numbers of the points
  for_each_edge([&](std::int32_t a, std::int32_t b) {
    if (uses[sorted(a, b)] > 1) return;
    const std::int32_t p = mesh.sewn[to_size(a)], q = mesh.sewn[to_size(b)];
    const Edge edge = p < q ? Edge(a, b) : Edge(b, a);
    const auto [other, is_first] = first_of.try_emplace(sorted(p, q), edge);
    if (is_first || p == q) return;
    const auto side = [&](const Edge& e) {
      return std::array{mesh.rest[to_size(e.first)], mesh.rest[to_size(e.second)]};
    };
    const Seam seam{side(other->second), side(edge)};
    if (seam.first != seam.second) seams.push_back(seam);  // else the lips of an incision
  });
  return seams;
}

namespace {

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

std::vector<SeamTie> seam_ties(const Sheet& sheet, std::span<const std::uint8_t> rank) {
  std::vector<SeamTie> ties;
  const std::vector<SewnEdge> edges = sewn_edges(sheet);
  if (edges.empty()) return ties;
  const std::size_t count = sheet.deformed_slots();
  UnionFind joined(count);
  std::vector<Hanging> hanging;
  for_each_pair(edges, [&](const SewnEdge& a, const SewnEdge& b) {
    const auto masters = ends_of(sheet, a), ends = ends_of(sheet, b);
    if (equal(a.low(), b.low())) joined.join(masters[0](), ends[0]());
    if (equal(a.high(), b.high())) joined.join(masters[1](), ends[1]());
    for (const auto& [vertex, place] : {std::pair{ends[0], b.low()}, std::pair{ends[1], b.high()}})
      if (place > a.low() + seam_rounding && place < a.high() - seam_rounding)
        hanging.push_back({vertex, masters, (place - a.low()) / (a.high() - a.low())});
  });

  std::vector<DeformedIndex> master(count);  // per class, at its smallest number
  const auto rank_of = [&](DeformedIndex d) { return d() < rank.size() ? rank[d()] : std::uint8_t{0}; };
  for (std::size_t i = 0; i < count; ++i) {
    DeformedIndex& best = master[joined.find(i)];
    if (!best.valid() || rank_of(DeformedIndex(i)) > rank_of(best)) best = DeformedIndex(i);
  }
  const auto master_of = [&](DeformedIndex d) { return master[joined.find(d())]; };

  std::map<DeformedIndex, Hanging> hangs;  // per master of a class
  for (const Hanging& h : hanging)
    if (rank_of(master_of(h.vertex)) < pinned_rank) hangs.try_emplace(master_of(h.vertex), h);
  const auto end_of_chain = [&](DeformedIndex d) {  // a master that hangs itself: the nearer one that does not
    for (std::size_t steps = 0; steps <= hangs.size(); ++steps) {
      const auto found = hangs.find(master_of(d));
      if (found == hangs.end()) return master_of(d);
      d = found->second.masters[found->second.weight > 0.5 ? 1 : 0];
    }
    return DeformedIndex();
  };
  for (std::size_t i = 0; i < count; ++i) {
    const DeformedIndex d(i), own = master_of(d);
    if (const auto found = hangs.find(own); found != hangs.end()) {
      const Hanging& h = found->second;
      const DeformedIndex a = end_of_chain(h.masters[0]), b = end_of_chain(h.masters[1]);
      if (!a.valid() || !b.valid()) continue;  // they hang on each other: none can lead
      const bool one = a == b;
      ties.push_back({d, {a, one ? DeformedIndex() : b}, {one ? 1.0 : 1 - h.weight, one ? 0.0 : h.weight}});
    } else if (own != d) {
      ties.push_back({d, {own, DeformedIndex()}, {1, 0}});
    }
  }
  return ties;
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
