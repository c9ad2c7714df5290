#include <cmath>
#include <map>

#include "harness/base/union_find.h"
#include "harness/mesh/seam_pairs.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

namespace {

DeformedIndex deformed_at(const Sheet& sheet, HalfEdge h) {
  return sheet.triangle(triangle_of(h)).deformed[to_size(corner_of(h))];
}

/// Deformed vertices at the two ends of a sewn edge, from 0 to 1 along the seam.
std::array<DeformedIndex, 2> ends_of(const Sheet& sheet, const SewnEdge& edge) {
  const DeformedIndex from = deformed_at(sheet, edge.edge), to = deformed_at(sheet, Sheet::next(edge.edge));
  return edge.begin < edge.end ? std::array{from, to} : std::array{to, from};
}

bool equal(double a, double b) { return std::abs(a - b) <= seam_rounding; }

/// Vertices along seams, those that are one in a class.
class Classes {
 public:
  Classes(const Sheet& sheet, std::span<const SewnEdge> edges, std::span<const std::uint8_t> rank)
      : sheet_(sheet), rank_(rank) {
    UnionFind joined(sheet.deformed_slots());
    for_each_pair(edges, [&](const SewnEdge& a, const SewnEdge& b) {
      const auto of_a = ends_of(sheet, a), of_b = ends_of(sheet, b);
      if (equal(a.low(), b.low())) joined.join(of_a[0](), of_b[0]());
      if (equal(a.high(), b.high())) joined.join(of_a[1](), of_b[1]());
    });
    master_.resize(sheet.deformed_slots());
    for (std::size_t i = 0; i < master_.size(); ++i) {  // first at the smallest number of each class
      DeformedIndex& best = master_[joined.find(i)];
      if (!best.valid() || rank_of(DeformedIndex(i)) > rank_of(best)) best = DeformedIndex(i);
    }
    for (std::size_t i = 0; i < master_.size(); ++i) master_[i] = master_[joined.find(i)];
    for_each_seam(edges, [&](std::span<const SewnEdge> of_seam) { hang(of_seam); });
  }

  DeformedIndex master(DeformedIndex d) const { return master_[d()]; }

  /// Of a class that hangs; none for others.
  const SeamTie* tie(DeformedIndex master) const {
    const auto found = ties_.find(master);
    return found == ties_.end() ? nullptr : &found->second;
  }

 private:
  struct Knot {
    double place;
    DeformedIndex master;
  };

  std::uint8_t rank_of(DeformedIndex d) const { return d() < rank_.size() ? rank_[d()] : std::uint8_t{0}; }

  /// Along one seam both sides are straight between what both have: each vertex between two such knots hangs on them.
  void hang(std::span<const SewnEdge> of_seam) {
    std::map<DeformedIndex, double> places;  // per master of a class that one side has within an edge of the other
    for (const SewnEdge& a : of_seam)
      for (const SewnEdge& b : of_seam) {
        if (!share_more_than_a_point(a, b)) continue;
        const auto ends = ends_of(sheet_, b);
        for (const auto& [vertex, place] : {std::pair{ends[0], b.low()}, std::pair{ends[1], b.high()}})
          if (place > a.low() + seam_rounding && place < a.high() - seam_rounding &&
              rank_of(master(vertex)) < pinned_rank)
            places.try_emplace(master(vertex), place);
      }
    for (const auto& [vertex, place] : places) {
      Knot before{-1, {}}, after{2, {}};
      for (const SewnEdge& edge : of_seam) {
        const auto ends = ends_of(sheet_, edge);
        const DeformedIndex low = master(ends[0]), high = master(ends[1]);
        if (edge.low() < place && edge.low() > before.place && !places.contains(low)) before = {edge.low(), low};
        if (edge.high() > place && edge.high() < after.place && !places.contains(high)) after = {edge.high(), high};
      }
      if (!before.master.valid() || !after.master.valid()) continue;
      const double weight = (place - before.place) / (after.place - before.place);
      ties_.try_emplace(vertex, SeamTie{vertex, {before.master, after.master}, {1 - weight, weight}});
    }
  }

  const Sheet& sheet_;
  std::span<const std::uint8_t> rank_;
  std::vector<DeformedIndex> master_;  // per vertex
  std::map<DeformedIndex, SeamTie> ties_;
};

}  // namespace

std::vector<SeamTie> seam_ties(const Sheet& sheet, std::span<const std::uint8_t> rank) {
  std::vector<SeamTie> ties;
  const std::vector<SewnEdge> edges = sewn_edges(sheet);
  if (edges.empty()) return ties;
  const Classes classes(sheet, edges, rank);
  for (std::size_t i = 0; i < sheet.deformed_slots(); ++i) {
    const DeformedIndex d(i), own = classes.master(d);
    if (const SeamTie* tie = classes.tie(own)) {
      ties.push_back({d, tie->masters, tie->weights});
    } else if (own != d) {
      ties.push_back({d, {own, DeformedIndex()}, {1, 0}});
    }
  }
  return ties;
}

}  // namespace cutbench
