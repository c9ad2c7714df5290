// The matrix of one level of a multigrid hierarchy, packed in the order in which its sweeps read it.
//
// A row has two parts, the entries below its diagonal and those above it: those of the rows that come before it and
// after it in the order of the sweep (sweep_order.h). Each part of all rows is a stream of its
// own. Blocks stand two by two: eight lanes hold a column of the one and a column of the other, each with a zero behind
// it. A scalar in the place of a block is added to its diagonal; the other scalars stand two by two, too. The columns
// of blocks rise below the diagonal and fall above it, so that a sweep, either way, needs the row before it last.
//
// The order of all sums follows from this layout (packed_kernel.h), so lanes of four and of eight give the same bits.
// What a cut touches is packed again row by row; a row that outgrows its room moves to the end.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <type_traits>

#include "harness/base/conversions.h"
#include "harness/fem/algebra/lanes.h"
#include "harness/fem/multigrid/sweep_order.h"

namespace cutbench {

template <class S>
struct QuadOf;
template <>
struct QuadOf<float> {
  using Type = float __attribute__((vector_size(16)));
};
template <>
struct QuadOf<double> {
  using Type = Lanes;
};
/// The D values of a vertex, then zeros or anything.
template <class S>
using Quad = typename QuadOf<S>::Type;
/// A Quad per vertex.
template <class S>
using PackedVector = std::vector<Quad<S>>;

/// Where the vertices of two blocks begin in a vector: four times their numbers.
struct PackedPair {
  std::array<std::int32_t, 2> offset;
};
template <class S>
struct TwoScalars {
  std::array<std::int32_t, 2> offset;
  std::array<S, 2> value;
};
/// The entries of all rows on one side of the diagonal.
template <int D, class S>
struct PackedPart {
  struct alignas(32) Values : std::array<S, 8> {};  // a column of each block of a pair
  GrowingRows<PackedPair> pairs;
  std::vector<Values> values;  // D per slot of pairs
  GrowingRows<TwoScalars<S>> scalars;
};

template <class S>
Quad<S> load_quad(const S* from) {
  Quad<S> quad;
  std::memcpy(&quad, from, sizeof quad);
  return quad;
}

/// The columns of a D x D block, each with anything behind it.
template <int D, class S>
using BlockColumns = std::array<Quad<S>, D>;

/// Of a block whose values stand column by column. Reads no further than the block.
template <int D, class T>
BlockColumns<D, T> columns_of(const T* block) {
  if constexpr (D == 2) {
    return {Quad<T>{block[0], block[1], 0, 0}, Quad<T>{block[2], block[3], 0, 0}};
  } else {
    const Quad<T> last = load_quad(block + 5);
    return {load_quad(block), load_quad(block + 3), __builtin_shufflevector(last, last, 1, 2, 3, 3)};
  }
}

/// Symmetric, of D x D blocks and of scalars that act on each coordinate alike. S: float, or double where floats would
/// not do.
template <int D, class S>
class PackedRows {
 public:
  using Vector = PackedVector<S>;
  using Block = Eigen::Matrix<double, D, D>;

  /// Packs these rows anew; the values of blocks are missing. All three must outlive this, and stay where they are.
  /// \param changed      SweepOrder::follow()
  /// \param keeps_small  the product is wanted, which takes the small scalars, too
  void follow(const LevelRows& rows, const SweptScalars& swept, const SweepOrder& order,
              std::span<const std::int32_t> changed);
  /// All, with room to grow by half.
  void follow(const LevelRows& rows, const SweptScalars& swept, const SweepOrder& order, bool keeps_small);
  const SweepOrder& order() const { return *order_; }
  std::size_t size() const { return inverse_.size() / D; }
  /// Entries beside the diagonal that a sweep reads, with those that fill up pairs.
  std::size_t block_count() const { return count(&PackedPart<D, S>::pairs); }
  std::size_t scalar_count() const { return count(&PackedPart<D, S>::scalars); }

  /// The values of row i. `columns_at(slot)` are the BlockColumns of a slot of the block rows, of any kind of numbers.
  template <class ColumnsAt>
  void fill_row(std::size_t i, const ColumnsAt& columns_at) {
    struct Target {
      S* begin;
      std::size_t stride;  // from column to column
    };
    const std::array<Target, 3> targets{{{begin(below_), 8}, {begin(diagonal_), 4}, {begin(above_), 8}}};
    const std::size_t first = rows_->blocks.first_slot(i), end = first + rows_->blocks[i].size();
    for (std::size_t slot = first; slot < end;
         ++slot) {  // a loop for each target would end where no processor foresees
      const Place& place = places_[slot];
      const Target& target = targets[place.at % 4];
      pack(columns_at(slot), place.scalar, target.stride, target.begin + (place.at - place.at % 4));
    }
  }
  /// The block on the diagonal of row i of the swept matrix. \pre the row is filled, and not empty
  Block diagonal(std::size_t i) const;
  /// The inverse of that, zero in rows and columns of held coordinates.
  void set_inverse(std::size_t i, const Block& inverse);

  /// Calls visit(column, value) for the entries of row i of the swept matrix; some are zeros that fill up pairs.
  template <class Visit>
  void for_each_block(std::size_t i, const Visit& visit) const {
    if (rows_->blocks[i].empty()) return;
    for (const auto* part : {&below_, &above_}) {
      std::size_t at = D * part->pairs.begin(i);
      for (const auto& pair : part->pairs[i]) {
        for (const std::size_t k : {0, 1}) {
          using Packed = Eigen::Map<const Eigen::Matrix<S, D, D>, 0, Eigen::OuterStride<8>>;
          visit(pair.offset[k] / 4, Eigen::Matrix<S, D, D>(Packed(part->values[at].data() + 4 * k)));
        }
        at += D;
      }
    }
    visit(to_int32(i), Eigen::Matrix<S, D, D>(diagonal(i).template cast<S>()));
  }
  template <class Visit>
  void for_each_scalar(std::size_t i, const Visit& visit) const {
    for (const auto* part : {&below_, &above_})
      for (const auto& two : part->scalars[i])
        for (const std::size_t k : {0, 1}) visit(two.offset[k] / 4, two.value[k]);
  }

  // For packed_kernel.h.
  const PackedPart<D, S>& below() const { return below_; }
  const PackedPart<D, S>& above() const { return above_; }
  const GrowingRows<TwoScalars<S>>& small() const { return small_; }
  const Quad<S>* diagonal_columns(std::size_t i) const { return diagonal_.data() + D * i; }
  const Quad<S>* inverse_columns(std::size_t i) const { return inverse_.data() + D * i; }

 private:
  /// Where a block goes.
  struct Place {
    std::uint32_t at;  // four times where its first column begins, plus 0 to 2: below, on or above the diagonal
    S scalar;          // in the same place
  };
  struct Entry {
    std::int32_t column, slot;
  };
  using Entries = std::vector<Entry>;
  struct Scalar {
    std::int32_t column;
    S value;
  };
  void part_row(const SweepRows& rows, std::size_t i);
  void pack_row(std::size_t i);
  void pack_pairs(Entries& blocks, PackedPart<D, S>& part, std::size_t i);
  void pack_scalars(const Entries& entries, GrowingRows<TwoScalars<S>>& to, std::size_t i);
  void pack_small(std::size_t i);
  void set_scalars(std::size_t n, GrowingRows<TwoScalars<S>>& to, std::size_t i);
  /// Writes columns `stride` values apart, with a scalar on the diagonal and zeros behind each.
  template <class BlockColumns>
  static void pack(const BlockColumns& columns, S scalar, std::size_t stride, S* to) {
    using T = std::remove_cvref_t<decltype(columns[0][0])>;
    constexpr std::array<Quad<T>, 3> unit{Quad<T>{1, 0, 0, 0}, Quad<T>{0, 1, 0, 0}, Quad<T>{0, 0, 1, 0}};
    for (std::size_t c = 0; c < D; ++c) {
      const Quad<T> column = columns[c] + static_cast<T>(scalar) * unit[c];
      const Quad<S> all = __builtin_convertvector(column, Quad<S>), zero{};
      const Quad<S> packed = __builtin_shufflevector(all, zero, 0, 1, 2, 7);
      std::memcpy(to + stride * c, &packed, sizeof packed);
    }
  }
  static S* begin(PackedPart<D, S>& part) { return reinterpret_cast<S*>(part.values.data()); }
  static S* begin(PackedVector<S>& quads) { return reinterpret_cast<S*>(quads.data()); }
  template <class Rows>
  std::size_t count(Rows PackedPart<D, S>::*rows) const {
    std::size_t n = 0;
    for (const auto* part : {&below_, &above_})
      for (std::size_t i = 0; i < size(); ++i) n += 2 * (part->*rows)[i].size();
    return n;
  }

  const LevelRows* rows_ = nullptr;
  const SweptScalars* swept_ = nullptr;
  const SweepOrder* order_ = nullptr;
  PackedPart<D, S> below_, above_;
  bool keeps_small_ = false;
  GrowingRows<TwoScalars<S>> small_;
  std::vector<Place> places_;  // per slot of the block rows
  PackedVector<S> diagonal_;   // D columns per row, without the small scalars
  PackedVector<S> inverse_;    // D columns per row
  // Working storage of pack_row().
  std::vector<std::int32_t> slot_of_;  // per column: of its block in the row at hand, or -1
  Entries before_, after_;             // of the row at hand
  std::vector<PackedPair> pairs_;
  std::vector<Scalar> scalars_;
  std::vector<TwoScalars<S>> two_scalars_;
};

}  // namespace cutbench
