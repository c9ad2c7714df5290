#include "harness/fem/multigrid/packed_rows.h"

#include <algorithm>
#include <numeric>

namespace cutbench {

namespace {

/// Two by two; an odd one gets zeros beside it that read the same vertex, so nothing else can make them NaN.
template <class Item>
void fill_up_pair(std::vector<Item>& items, Item last) {
  if (items.size() % 2) items.push_back(last);
}

}  // namespace

template <int D, class S>
void PackedRows<D, S>::follow(const LevelRows& rows, const SweptScalars& swept, std::span<const std::int32_t> changed) {
  rows_ = &rows;
  swept_ = &swept;
  const std::size_t n = rows.size();
  for (auto* part : {&below_, &above_}) {
    part->pairs.resize(n);
    part->scalars.resize(n);
  }
  if (keeps_small_) small_.resize(n);
  places_.resize(rows.blocks.slots());
  diagonal_.resize(D * n);
  inverse_.resize(D * n);
  for (const std::int32_t row : changed) pack_row(to_size(row));
}

template <int D, class S>
void PackedRows<D, S>::follow(const LevelRows& rows, const SweptScalars& swept, bool keeps_small) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  *this = {};
  keeps_small_ = keeps_small;
  follow(rows, swept, all);
  for (auto* part : {&below_, &above_}) {
    part->pairs.reserve_spare();
    part->scalars.reserve_spare();
    cutbench::reserve_spare(part->values);
  }
  small_.reserve_spare();
  cutbench::reserve_spare(places_, diagonal_, inverse_);
}

template <int D, class S>
void PackedRows<D, S>::pack_row(std::size_t i) {
  pack_part(below_, i);
  pack_part(above_, i);
  if (keeps_small_) pack_small(i);
  const auto& [blocks, scalars, scalar] = *rows_;
  const S own = scalars[i].empty() ? 0 : static_cast<S>(scalar[scalars.diagonal_slot(i)]);
  if (!blocks[i].empty()) places_[blocks.diagonal_slot(i)] = {static_cast<std::uint32_t>(D * i), own};
  for (std::size_t k = D * i; k < D * (i + 1); ++k) diagonal_[k] = inverse_[k] = Quad<S>{};
}

template <int D, class S>
void PackedRows<D, S>::pack_part(PackedPart<D, S>& part, std::size_t i) {
  const bool is_below = &part == &below_;
  // The entries of this side, by their columns.
  const auto collect = [&](const SweepRows& rows, std::vector<Entry>& entries) {
    entries.clear();
    if (rows[i].empty()) return;
    std::size_t slot = is_below ? rows.first_slot(i) : rows.diagonal_slot(i) + 1;
    for (const std::int32_t j : is_below ? rows.below(i) : rows.above(i)) entries.push_back({j, to_int32(slot++), 0});
    std::sort(entries.begin(), entries.end(),
              [&](const Entry& a, const Entry& b) { return is_below ? a.column < b.column : a.column > b.column; });
  };
  collect(rows_->blocks, blocks_);
  collect(swept_->rows(), near_);
  for (Entry& entry : near_) entry.value = swept_->values()[to_size(entry.slot)];
  // A scalar in the place of a block is added to it; what is left stands behind.
  std::size_t left = 0, next = 0;
  const auto leave = [&](std::size_t k) { near_[left++] = near_[k]; };
  const auto is_before = [&](std::int32_t a, std::int32_t b) { return is_below ? a < b : a > b; };
  for (Entry& block : blocks_) {
    while (next < near_.size() && is_before(near_[next].column, block.column)) leave(next++);
    if (next < near_.size() && near_[next].column == block.column) block.value = near_[next++].value;
  }
  while (next < near_.size()) leave(next++);
  near_.resize(left);

  if (!blocks_.empty()) fill_up_pair(blocks_, {blocks_.back().column, -1, 0});
  if (!near_.empty()) fill_up_pair(near_, {near_.back().column, -1, 0});
  pairs_.clear();
  for (std::size_t k = 0; k < blocks_.size(); k += 2)
    pairs_.push_back({{4 * blocks_[k].column, 4 * blocks_[k + 1].column}});
  part.pairs.set(i, pairs_);
  part.values.resize(D * part.pairs.slots());
  const std::size_t first = part.pairs.begin(i);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (blocks_[k].slot < 0) continue;
    const std::size_t quad = 2 * D * (first + k / 2) + k % 2;
    places_[to_size(blocks_[k].slot)] = {static_cast<std::uint32_t>(quad), static_cast<S>(blocks_[k].value)};
  }
  for (std::size_t k = 0; k < D * pairs_.size(); ++k) part.values[D * first + k] = {};
  pack_scalars(near_, part.scalars, i);
}

template <int D, class S>
void PackedRows<D, S>::pack_scalars(const std::vector<Entry>& entries, GrowingRows<TwoScalars<S>>& to, std::size_t i) {
  scalars_.clear();
  for (std::size_t k = 0; k < entries.size(); k += 2)
    scalars_.push_back({{4 * entries[k].column, 4 * entries[k + 1].column},
                        {static_cast<S>(entries[k].value), static_cast<S>(entries[k + 1].value)}});
  to.set(i, scalars_);
}

template <int D, class S>
void PackedRows<D, S>::pack_small(std::size_t i) {
  near_.clear();
  std::size_t slot = rows_->scalars.first_slot(i);
  for (const std::int32_t j : rows_->scalars[i]) {
    const double value = rows_->scalar[slot++];
    if (to_size(j) != i && swept_->is_small(i, to_size(j), value)) near_.push_back({j, 0, value});
  }
  if (!near_.empty()) fill_up_pair(near_, {near_.back().column, -1, 0});
  pack_scalars(near_, small_, i);
}

template <int D, class S>
auto PackedRows<D, S>::diagonal(std::size_t i) const -> Block {
  Block all;
  for (int c = 0; c < D; ++c)
    for (int k = 0; k < D; ++k) all(k, c) = to_double(diagonal_[D * i + to_size(c)][k]);
  all.diagonal().array() += swept_->left_out(i);
  return all;
}

template <int D, class S>
void PackedRows<D, S>::set_inverse(std::size_t i, const Block& inverse) {
  for (int c = 0; c < D; ++c)
    for (int k = 0; k < D; ++k) inverse_[D * i + to_size(c)][k] = static_cast<S>(inverse(k, c));
}

template class PackedRows<2, float>;
template class PackedRows<3, float>;
template class PackedRows<2, double>;
template class PackedRows<3, double>;

}  // namespace cutbench
