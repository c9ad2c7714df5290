// The levels of a multigrid hierarchy: made anew from the rows of the matrix, and brought up to date after a cut.
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/multigrid/multigrid.h"

namespace cutbench {

namespace {

constexpr double strong = 0.5;       // share of a vertex's stiffness; 1/4 in a square grid, 1/6 in a regular one
constexpr double first_spacing = 2;  // of the lattice, in median edges
constexpr std::size_t fewest_coarsened = 40;  // unknowns that are not coarsened any further

double median_edge(const SweepRows& links, const std::vector<Point2>& places) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const std::int32_t j : links[i])
      if (to_size(j) > i)
        if (const double l = length(places[to_size(j)] - places[i]); l > 0 && std::isfinite(l)) lengths.push_back(l);
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + to_index(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

/// Vertices that slivers constraint together: one has more than `strong` of its stiffness from the other. Neither the
/// hats nor the sweeps move them together against their neighbours. Looks at what has changed, and at all groups there.
template <int D>
Coarsening::Regrouping Multigrid<D>::regroup(const SystemMatrix<D>& a) {
  const auto stiffness = [&](std::size_t i) { return a.blocks->block(a.blocks->first_slot(i)).trace(); };
  const auto for_each_strong = [&](std::size_t i, const auto& visit) {
    std::size_t slot = rows_.blocks.first_slot(i);
    for (const std::int32_t j : rows_.blocks[i])
      if (-a.blocks->block(slots_[slot++]).trace() > strong * std::min(stiffness(i), stiffness(to_size(j)))) visit(j);
  };
  Coarsening::Regrouping found;
  front_.clear();
  const auto reach = [&](std::int32_t v) {
    auto& place = place_in_front_[to_size(v)];
    if (place < 0) {
      place = to_int32(front_.size());
      front_.push_back(v);
    }
  };
  for (const std::int32_t v : changed_) reach(v);
  for (std::size_t k = 0; k < front_.size(); ++k) {
    const auto v = to_size(front_[k]);
    const std::int32_t group = coarse_.empty() ? -1 : coarse_.front().from.group_of(v);
    if (group >= 0)
      for (const auto& member : coarse_.front().from.members(to_size(group))) reach(member.other);
    for_each_strong(v, reach);
  }
  UnionFind joined(front_.size());
  for (std::size_t k = 0; k < front_.size(); ++k)
    for_each_strong(to_size(front_[k]), [&](std::int32_t j) { joined.join(k, to_size(place_in_front_[to_size(j)])); });
  std::vector<std::int32_t> group_of(front_.size(), -1);
  for (std::size_t k = 0; k < front_.size(); ++k) {
    place_in_front_[to_size(front_[k])] = -1;
    if (joined.size(k) == 1 || small_.holds(to_size(front_[k]))) continue;
    auto& group = group_of[joined.find(k)];
    if (group < 0) {
      group = to_int32(found.groups.size());
      found.groups.emplace_back();
    }
    found.groups[to_size(group)].push_back(front_[k]);
  }
  found.members = front_;
  return found;
}

template <int D>
auto Multigrid<D>::finer_than_next(const CoarseLevel& level) -> Finer {
  return {&level.rows, &level.swept, &level.from.coarse_places(), &level.from.changes()};
}

template <int D>
void Multigrid<D>::update_rows(CoarseLevel& level, const Finer& fine, const Coarsening::Regrouping& regrouping) {
  const FineRows rows{fine.rows->blocks, fine.swept->rows(), fine.swept->values()};
  level.from.update(rows, *fine.places, *fine.changes, regrouping);
  level.from.multiply(rows, level.rows);
}

template <int D>
void Multigrid<D>::make_levels(const SystemMatrix<D>& a) {
  coarse_.clear();
  float_is_new_ = double_is_new_ = true;
  rows_.reserve_spare();
  swept_.follow(rows_);
  order_.follow(rows_, swept_);
  cutbench::reserve_spare(slots_);
  slots_made_ = rows_.blocks.slots();
  double spacing = first_spacing * median_edge(rows_.blocks, places_);
  if (!(spacing > 0)) return;
  Coarsening::Regrouping regrouping = regroup(a);
  Finer fine{&rows_, &swept_, &places_, &changes_};
  for (; fine.rows->size() > fewest_coarsened; spacing *= 2) {
    CoarseLevel& level = coarse_.emplace_back(spacing);
    update_rows(level, fine, regrouping);
    if (const std::size_t n = level.rows.size(); n == 0 || 10 * n > 8 * fine.rows->size()) return coarse_.pop_back();
    level.from.reserve_spare();
    level.rows.reserve_spare();
    level.swept.follow(level.rows);
    level.order.follow(level.rows, level.swept);
    level.matrix.follow(level.rows, level.swept, level.order, false);
    level.resize();
    fine = finer_than_next(level);
    regrouping = {};
  }
}

template <int D>
void Multigrid<D>::update_levels(const SystemMatrix<D>& a) {
  Coarsening::Regrouping regrouping = regroup(a);
  swept_.follow(rows_, changes_.rows);
  const auto to_pack = order_.follow(rows_, swept_, changes_.rows);
  if (!float_is_new_) {
    finest_.matrix.follow(rows_, swept_, order_, to_pack);
    finest_.resize();
  }
  if (!double_is_new_) {
    finest_in_doubles_.matrix.follow(rows_, swept_, order_, to_pack);
    finest_in_doubles_.resize();
  }
  Finer fine{&rows_, &swept_, &places_, &changes_};
  for (CoarseLevel& level : coarse_) {
    update_rows(level, fine, regrouping);
    level.swept.follow(level.rows, level.from.changes().rows);
    level.matrix.follow(level.rows, level.swept, level.order,
                        level.order.follow(level.rows, level.swept, level.from.changes().rows));
    level.resize();
    fine = finer_than_next(level);
    regrouping = {};
  }
}

// What setup() calls; multigrid.cpp instantiates the rest of the class.
template void Multigrid<2>::make_levels(const SystemMatrix<2>&);
template void Multigrid<2>::update_levels(const SystemMatrix<2>&);
template void Multigrid<3>::make_levels(const SystemMatrix<3>&);
template void Multigrid<3>::update_levels(const SystemMatrix<3>&);

}  // namespace cutbench
