#include "harness/fem/multigrid/multigrid.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"

namespace cutbench {

namespace {

/// All places that are not finite are alike.
bool is_same(Point2 a, Point2 b) { return (a.x == b.x && a.y == b.y) || (std::isnan(a.x) && std::isnan(b.x)); }

void sort_unique(std::vector<std::int32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

// --- rows ------------------------------------------------------------------------------------------------------------

/// Lists the rows that are not those of the last setup(). False: the levels are to be made anew.
template <int D>
bool Multigrid<D>::find_changed(const SystemMatrix<D>& a) {
  const std::size_t n = a.vertices(), before = rows_.size();
  const bool same_factors = std::equal(factors_.begin(), factors_.end(), a.scalar.begin(), a.scalar.end(),
                                       [](double factor, const auto& term) { return factor == term.factor; });
  changed_.clear();
  if (a.pattern == pattern_ && before == n && same_factors) return true;
  const bool follows = same_factors && before > 0 && before <= n && a.history && a.history->holds(pattern_) &&
                       rows_.blocks.slots() < 2 * slots_made_;
  if (follows) {
    const auto marked = a.history->changed_since(pattern_);
    changed_.assign(marked.begin(), marked.end());
    for (std::size_t i = before; i < n; ++i) changed_.push_back(to_int32(i));
    sort_unique(changed_);
    if (2 * changed_.size() < n) return true;
  }
  changed_.resize(n);
  std::iota(changed_.begin(), changed_.end(), 0);
  return false;
}

/// The row of A; the scalar matrices in one, each with its factor.
template <int D>
void Multigrid<D>::read_row(const SystemMatrix<D>& a, std::size_t i) {
  const auto [order, is_linked_anew] = rows_.blocks.set(i, a.blocks->columns(i));
  slots_.resize(rows_.blocks.slots());
  for (std::size_t k = 0; k < order.size(); ++k)
    slots_[rows_.blocks.first_slot(i) + k] = a.blocks->first_slot(i) + order[k];
  scalars_.clear();
  for (const auto& term : a.scalar) {
    std::int32_t slot = term.matrix->first_slot(i);
    for (const std::int32_t j : term.matrix->columns(i)) scalars_[j] += term.factor * term.matrix->block(slot++)(0);
  }
  const bool has_new_scalars = rows_.set_scalars(i, scalars_.columns(), scalars_.sums());
  if (is_linked_anew || has_new_scalars) changes_.rows.push_back(to_int32(i));
  if (is_linked_anew) changes_.links.push_back(to_int32(i));
}

/// The levels leave out what is held, and small pieces.
template <int D>
void Multigrid<D>::read_place(const SystemMatrix<D>& a, std::size_t i) {
  const bool is_known = a.places && i < a.places->size() && !is_held_altogether(a, i) && !small_.holds(i);
  const Point2 place = is_known ? (*a.places)[i] : Point2{std::numeric_limits<double>::quiet_NaN(), 0};
  if (!is_same(std::exchange(places_[i], place), place)) changes_.links.push_back(to_int32(i));
}

template <int D>
void Multigrid<D>::find_held(const SystemMatrix<D>& a) {
  is_near_held_.assign(a.vertices(), 0);
  held_.clear();
  for (std::size_t u = 0; u < a.held->size(); ++u) {
    if (!(*a.held)[u]) continue;
    held_.push_back(to_index(u));
    is_near_held_[u / D] = 1;
    for (const std::int32_t j : a.blocks->columns(u / D)) is_near_held_[to_size(j)] = 1;
  }
}

/// Adds to the rows that have changed those of vertices that have become twice as stiff or half as stiff, beside the
/// median: strains stiffen polygons without a cut, and then other vertices move together.
template <int D>
void Multigrid<D>::find_restiffened() {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < looked_at_.size(); ++i) {
    const double now = sizes_[i] / median_size_;
    if (now > 2 * looked_at_[i] || 2 * now < looked_at_[i]) found.push_back(to_int32(i));
  }
  if (2 * found.size() >= looked_at_.size()) return;  // another matrix altogether
  changed_.insert(changed_.end(), found.begin(), found.end());
  sort_unique(changed_);
}

template <int D>
void Multigrid<D>::setup(const SystemMatrix<D>& a) {
  a.diagonals(diagonals_, *workers_);
  setup(a, diagonals_);
}

template <int D>
void Multigrid<D>::setup(const SystemMatrix<D>& a, const Blocks& diagonals) {
  const bool follows = find_changed(a);
  look_at_sizes(a, diagonals);
  if (follows) find_restiffened();
  StopWatch watch;
  if (!changed_.empty()) {
    const std::size_t n = a.vertices();
    if (!follows) {
      rows_ = {};
      factors_.clear();
      small_ = {};
    }
    rows_.resize(n);
    places_.resize(n);
    scalars_.resize(n);
    place_in_front_.resize(n, -1);
    looked_at_.resize(n);
    changes_ = {};
    for (const std::int32_t i : changed_) {
      read_row(a, to_size(i));
      looked_at_[to_size(i)] = sizes_[to_size(i)] / median_size_;
    }
    const auto moved = small_.follow(rows_, *a.held, changed_);
    changed_.insert(changed_.end(), moved.begin(), moved.end());
    sort_unique(changed_);
    for (const std::int32_t i : changed_) read_place(a, to_size(i));
    sort_unique(changes_.links);
    if (!follows)
      for (const auto& term : a.scalar) factors_.push_back(term.factor);
    follows ? update_levels(a) : make_levels(a);
  }
  pattern_ = a.pattern;
  rows_us_ = watch.lap();
  find_held(a);
  leave_out_small_pieces(a);
  if (!changed_.empty()) clusters_.find(sizes_, median_size_, rows_);
  choose_precision(a);
  fill_finest(a, diagonals);
  fill_coarse_levels(a);
}

template <int D>
auto Multigrid<D>::entries() const -> Entries {
  Entries all;
  const auto add = [&](const auto& level) {
    all.blocks += to_double(level.matrix.block_count());
    all.scalars += to_double(level.matrix.scalar_count());
  };
  in_doubles_ ? add(finest_in_doubles_) : add(finest_);
  for (const CoarseLevel& level : coarse_) add(level);
  return all;
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace cutbench
