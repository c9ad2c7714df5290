#include "harness/fem/multigrid/sweep_order.h"

#include <algorithm>
#include <numeric>

namespace cutbench {

template <class Visit>
void SweepOrder::for_each_coupled(const LevelRows& rows, const SweptScalars& swept, std::size_t i,
                                  const Visit& visit) const {
  for (const std::int32_t j : rows.blocks[i]) visit(to_size(j));
  for (const std::int32_t j : swept.rows()[i]) visit(to_size(j));
}

void SweepOrder::put(std::size_t i, std::int32_t band) {
  constexpr std::uint64_t by_turn = std::uint64_t{1} << 32;
  band_[i] = band;
  rank_[i] = (band == none ? 2 : to_size(band % 2)) * by_turn + i;
}

/// True where no other band of the same turn is coupled to row i.
bool SweepOrder::suits(const LevelRows& rows, const SweptScalars& swept, std::size_t i) const {
  const std::int32_t mine = band_[i];
  if (mine == none) return true;
  bool does = true;
  for_each_coupled(rows, swept, i, [&](std::size_t j) {
    const std::int32_t other = band_[j];
    does &= other == mine || other == none || (other - mine) % 2 != 0;
  });
  return does;
}

/// The rows parted evenly; those that do not suit their band are the rest. False where these are too many.
bool SweepOrder::make_bands(const LevelRows& rows, const SweptScalars& swept, std::size_t bands) {
  const std::size_t n = rows.size(), length = (n + bands - 1) / bands, most_left_over = n / 10;
  for (auto& of_turn : bands_) of_turn.assign(bands / 2, {});
  rest_.clear();
  for (std::size_t i = 0; i < n; ++i) put(i, to_int32(i / length));
  for (std::size_t i = 0; i < n; ++i) {
    if (!suits(rows, swept, i)) put(i, none);
    rows_of(band_[i]).push_back(to_int32(i));
    if (rest_.size() > most_left_over) return false;
  }
  return true;
}

void SweepOrder::follow(const LevelRows& rows, const SweptScalars& swept) {
  const std::size_t n = rows.size();
  band_.assign(n, none);
  rank_.assign(n, 0);
  if (n >= fewest_in_bands_)
    for (const std::size_t bands : {16, 8, 4})
      if (make_bands(rows, swept, bands)) return;
  for (auto& of_turn : bands_) of_turn.clear();
  for (std::size_t i = 0; i < n; ++i) put(i, none);
  rest_.resize(n);
  std::iota(rest_.begin(), rest_.end(), 0);
}

/// One that suits all that row i is coupled to, of those that most of these are in.
std::int32_t SweepOrder::band_for(const LevelRows& rows, const SweptScalars& swept, std::size_t i) const {
  struct Seen {
    std::int32_t band = none;
    int rows = 0;
    bool is_only_one = true;
  };
  std::array<Seen, 2> seen;
  for_each_coupled(rows, swept, i, [&](std::size_t j) {
    if (band_[j] == none || j == i) return;
    Seen& of_turn = seen[to_size(band_[j] % 2)];
    of_turn.is_only_one &= of_turn.band == none || of_turn.band == band_[j];
    of_turn.band = band_[j];
    ++of_turn.rows;
  });
  const auto votes = [](const Seen& of_turn) { return of_turn.is_only_one ? of_turn.rows : 0; };
  const Seen& best = votes(seen[1]) > votes(seen[0]) ? seen[1] : seen[0];
  return votes(best) > 0 ? best.band : none;
}

std::span<const std::int32_t> SweepOrder::follow(const LevelRows& rows, const SweptScalars& swept,
                                                 std::span<const std::int32_t> changed) {
  const std::size_t before = band_.size(), n = rows.size();
  band_.resize(n, none);
  rank_.resize(n);
  is_listed_.resize(n);
  to_pack_.assign(changed.begin(), changed.end());
  for (const std::int32_t i : changed) is_listed_[to_size(i)] = 1;
  const auto list = [&](std::size_t i) {
    if (is_listed_[i]) return;
    is_listed_[i] = 1;
    to_pack_.push_back(to_int32(i));
  };
  for (std::size_t i = before; i < n; ++i) {
    put(i, none);
    rest_.push_back(to_int32(i));
    list(i);
  }
  const std::size_t looked_at = bands_[0].empty() ? 0 : to_pack_.size();  // what comes behind is only packed again
  for (std::size_t k = 0; k < looked_at; ++k) {
    const auto i = to_size(to_pack_[k]);
    if (band_[i] == none ? i < before : suits(rows, swept, i)) continue;
    const auto remove = [&](Rows& from) { from.erase(std::lower_bound(from.begin(), from.end(), to_int32(i))); };
    const auto insert = [&](Rows& to) { to.insert(std::lower_bound(to.begin(), to.end(), to_int32(i)), to_int32(i)); };
    remove(rows_of(band_[i]));
    put(i, band_for(rows, swept, i));
    insert(rows_of(band_[i]));
    for_each_coupled(rows, swept, i, list);
  }
  for (const std::int32_t i : to_pack_) is_listed_[to_size(i)] = 0;
  return to_pack_;
}

}  // namespace cutbench
