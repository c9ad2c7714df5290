#include "harness/fem/multigrid/packed_rows.h"

#include <algorithm>
#include <numeric>

namespace cutbench {

namespace {

/// Of PackedRows::Place.
std::uint32_t place_at(std::size_t quad, std::uint32_t part) { return static_cast<std::uint32_t>(4 * quad) + part; }

}  // namespace

template <int D, class S>
void PackedRows<D, S>::follow(const LevelRows& rows, const SweptScalars& swept, const SweepOrder& order,
                              std::span<const std::int32_t> changed) {
  rows_ = &rows;
  swept_ = &swept;
  order_ = &order;
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
void PackedRows<D, S>::follow(const LevelRows& rows, const SweptScalars& swept, const SweepOrder& order,
                              bool keeps_small) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  *this = {};
  keeps_small_ = keeps_small;
  follow(rows, swept, order, all);
  for (auto* part : {&below_, &above_}) {
    part->pairs.reserve_spare();
    part->scalars.reserve_spare();
    cutbench::reserve_spare(part->values);
  }
  small_.reserve_spare();
  cutbench::reserve_spare(places_, diagonal_, inverse_);
}

/// The entries of row i beside its own in two lists. Which of them an entry belongs to is a coin toss, so there is no
/// branch.
template <int D, class S>
void PackedRows<D, S>::part_row(const SweepRows& rows, std::size_t i) {
  const auto columns = rows[i];
  const auto own = to_int32(i);
  before_.resize(columns.size() + 1);
  after_.resize(columns.size() + 1);
  std::size_t before = 0, after = 0;
  auto slot = to_int32(rows.first_slot(i));
  for (const std::int32_t j : columns) {
    before_[before] = after_[after] = {j, slot++};
    const bool is_before = order_->is_before(j, own);
    before += is_before;
    after += j != own && !is_before;
  }
  before_.resize(before);
  after_.resize(after);
}

template <int D, class S>
void PackedRows<D, S>::pack_row(std::size_t i) {
  const auto& [blocks, scalars, scalar] = *rows_;
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
  part_row(swept_->rows(), i);
  pack_scalars(before_, below_.scalars, i);
  pack_scalars(after_, above_.scalars, i);
  Place& own = places_[blocks.diagonal_slot(i)];
  if (!swept_->rows()[i].empty()) own.scalar = static_cast<S>(scalar[scalars.diagonal_slot(i)]);
  own.at = place_at(D * i, 1);
  part_row(blocks, i);
  pack_pairs(before_, below_, i);
  pack_pairs(after_, above_, i);
  for (const std::int32_t j : blocks[i]) slot_of_[to_size(j)] = -1;
}

/// The blocks on one side of the diagonal, the farthest first. An odd one gets zeros beside it that read the same
/// vertex, so nothing else can make them NaN.
template <int D, class S>
void PackedRows<D, S>::pack_pairs(Entries& blocks, PackedPart<D, S>& part, std::size_t i) {
  const bool is_below = &part == &below_;
  std::sort(blocks.begin(), blocks.end(), [&](const Entry& a, const Entry& b) {
    return is_below ? order_->is_before(a.column, b.column) : order_->is_before(b.column, a.column);
  });
  const std::size_t n = blocks.size();
  if (n % 2) blocks.push_back(blocks.back());
  pairs_.clear();
  for (std::size_t k = 0; k < n; k += 2) pairs_.push_back({{4 * blocks[k].column, 4 * blocks[k + 1].column}});
  part.pairs.set(i, pairs_);
  part.values.resize(D * part.pairs.slots());
  const std::size_t first = part.pairs.begin(i);
  for (std::size_t k = 0; k < n; ++k)
    places_[to_size(blocks[k].slot)].at = place_at(2 * D * (first + k / 2) + k % 2, is_below ? 0 : 2);
  if (n % 2) std::fill_n(part.values.begin() + to_index(D * (first + n / 2)), D, typename PackedPart<D, S>::Values{});
}

/// The scalars on one side of the diagonal: in the places of blocks, and the others. Which it is is a coin toss, so
/// there is no branch.
template <int D, class S>
void PackedRows<D, S>::pack_scalars(const Entries& entries, GrowingRows<TwoScalars<S>>& to, std::size_t i) {
  scalars_.resize(entries.size() + 1);
  std::size_t n = 0;
  Place nowhere{};
  for (const auto& [j, slot] : entries) {
    const std::int32_t block = slot_of_[to_size(j)];
    const auto value = static_cast<S>(swept_->values()[to_size(slot)]);
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
