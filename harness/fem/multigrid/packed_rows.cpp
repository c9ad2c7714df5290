#include "harness/fem/multigrid/packed_rows.h"

#include <algorithm>
#include <numeric>

namespace cutbench {

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
  slot_of_.resize(n, -1);
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
  const auto& [blocks, scalars, scalar] = *rows_;
  const SweepRows& near = swept_->rows();
  if (keeps_small_) pack_small(i);
  if (blocks[i].empty()) {
    for (std::size_t k = D * i; k < D * (i + 1); ++k) diagonal_[k] = inverse_[k] = Quad<S>{};
    for (auto* part : {&below_, &above_}) {
      part->pairs.set(i, {});
      part->scalars.set(i, {});
    }
    return;
  }
  for (std::size_t k = 0; k < blocks[i].size(); ++k) {
    const std::size_t slot = blocks.first_slot(i) + k;
    slot_of_[to_size(blocks[i][k])] = to_int32(slot);
    places_[slot].scalar = 0;
  }
  if (near[i].empty()) {
    pack_scalars({}, 0, below_.scalars, i);
    pack_scalars({}, 0, above_.scalars, i);
  } else {
    pack_scalars(near.below(i), near.first_slot(i), below_.scalars, i);
    pack_scalars(near.above(i), near.diagonal_slot(i) + 1, above_.scalars, i);
    places_[blocks.diagonal_slot(i)].scalar = static_cast<S>(scalar[scalars.diagonal_slot(i)]);
  }
  pack_pairs(blocks.below(i), blocks.first_slot(i), below_, i);
  pack_pairs(blocks.above(i), blocks.diagonal_slot(i) + 1, above_, i);
  places_[blocks.diagonal_slot(i)].quad = static_cast<std::uint32_t>(D * i);
  for (const std::int32_t j : blocks[i]) slot_of_[to_size(j)] = -1;
}

/// The blocks on one side of the diagonal, the farthest first. An odd one gets zeros beside it that read the same
/// vertex, so nothing else can make them NaN.
template <int D, class S>
void PackedRows<D, S>::pack_pairs(std::span<const std::int32_t> columns, std::size_t slot, PackedPart<D, S>& part,
                                  std::size_t i) {
  blocks_.clear();
  for (const std::int32_t j : columns) blocks_.push_back({j, to_int32(slot++)});
  const bool is_below = &part == &below_;
  std::sort(blocks_.begin(), blocks_.end(),
            [&](const Entry& a, const Entry& b) { return is_below ? a.column < b.column : a.column > b.column; });
  const std::size_t n = blocks_.size();
  if (n % 2) blocks_.push_back(blocks_.back());
  pairs_.clear();
  for (std::size_t k = 0; k < n; k += 2) pairs_.push_back({{4 * blocks_[k].column, 4 * blocks_[k + 1].column}});
  part.pairs.set(i, pairs_);
  part.values.resize(D * part.pairs.slots());
  const std::size_t first = part.pairs.begin(i);
  for (std::size_t k = 0; k < n; ++k)
    places_[to_size(blocks_[k].slot)].quad = static_cast<std::uint32_t>(2 * D * (first + k / 2) + k % 2);
  if (n % 2) std::fill_n(part.values.begin() + to_index(D * (first + n / 2)), D, typename PackedPart<D, S>::Values{});
}

/// The scalars on one side of the diagonal: in the places of blocks, and the others. Which it is is a coin toss, so
/// there is no branch.
template <int D, class S>
void PackedRows<D, S>::pack_scalars(std::span<const std::int32_t> columns, std::size_t slot,
                                    GrowingRows<TwoScalars<S>>& to, std::size_t i) {
  scalars_.resize(columns.size() + 1);
  std::size_t n = 0;
  Place nowhere{};
  for (const std::int32_t j : columns) {
    const std::int32_t block = slot_of_[to_size(j)];
    const auto value = static_cast<S>(swept_->values()[slot++]);
    (block < 0 ? nowhere : places_[to_size(block)]).scalar = value;
    scalars_[n] = {j, value};
    n += block < 0;
  }
  set_scalars(n, to, i);
}

/// The first n of scalars_, two by two.
template <int D, class S>
void PackedRows<D, S>::set_scalars(std::size_t n, GrowingRows<TwoScalars<S>>& to, std::size_t i) {
  if (n % 2) {
    scalars_[n] = {scalars_[n - 1].column, 0};
    ++n;
  }
  two_scalars_.clear();
  for (std::size_t k = 0; k < n; k += 2)
    two_scalars_.push_back(
        {{4 * scalars_[k].column, 4 * scalars_[k + 1].column}, {scalars_[k].value, scalars_[k + 1].value}});
  to.set(i, two_scalars_);
}

template <int D, class S>
void PackedRows<D, S>::pack_small(std::size_t i) {
  const auto columns = rows_->scalars[i];
  scalars_.resize(columns.size() + 1);
  std::size_t slot = rows_->scalars.first_slot(i), n = 0;
  for (const std::int32_t j : columns) {
    const double value = rows_->scalar[slot++];
    scalars_[n] = {j, static_cast<S>(value)};
    n += to_size(j) != i && swept_->is_small(i, to_size(j), value);
  }
  set_scalars(n, small_, i);
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
