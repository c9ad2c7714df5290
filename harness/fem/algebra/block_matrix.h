// Square sparse matrix of D x D blocks whose rows can be changed one by one: what a cut touches is rewritten, the rest
// stays where it is. D = 1 is an ordinary sparse matrix; it can be applied to each coordinate of a vertex alike.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/prefetch.h"
#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/algebra/lanes.h"
#include "harness/fem/algebra/workers.h"

namespace cutbench {

/// D values per vertex, those of one vertex together.
using Field = Eigen::VectorXd;
using FieldView = Eigen::Map<const Field>;

template <int D>
class BlockMatrix {
 public:
  using Block = Eigen::Matrix<double, D, D>;

  std::size_t rows() const { return columns_.size(); }
  void resize(std::size_t rows) { columns_.resize(rows); }
  /// Room for half as many blocks again, before they have to be copied.
  void reserve_spare() {
    columns_.reserve_spare();
    cutbench::reserve_spare(blocks_);
  }
  /// Gives row i these columns, the diagonal first; its values become zero. Where the row has outgrown its room it
  /// moves to the end, so slots of this row change, of others not. \pre `columns` is empty (a row of zeros), or begins
  /// with i and holds no column twice.
  void set_row(std::size_t i, std::span<const std::int32_t> columns);
  /// The slot that keeps block (i, j); -1 where there is none.
  std::int32_t find(std::size_t i, std::int32_t j) const;

  std::span<const std::int32_t> columns(std::size_t i) const { return columns_[i]; }
  /// Slot of the first block in row i, the diagonal one; the others follow in the order of columns().
  std::int32_t first_slot(std::size_t i) const { return to_int32(columns_.begin(i)); }
  /// Adds a block to each of four slots: lane l of entry k, column by column, to the block in slots[l]. Slots below
  /// zero are left out.
  void add(const std::array<std::int32_t, lane_count>& slots, const std::array<Lanes, D * D>& entries) {
    constexpr std::size_t fours = D * D / 4, rest = 4 * fours;
    std::array<std::array<Lanes, lane_count>, fours> turned;  // four entries each, of the four blocks
    for (std::size_t k = 0; k < fours; ++k)
      turned[k] = transposed(entries[4 * k], entries[4 * k + 1], entries[4 * k + 2], entries[4 * k + 3]);
    for (std::size_t l = 0; l < lane_count; ++l) {
      if (slots[l] < 0) continue;
      double* const to = blocks_[to_size(slots[l])].data();
      for (std::size_t k = 0; k < fours; ++k) store(load(to + 4 * k) + turned[k][l], to + 4 * k);
      for (std::size_t k = rest; k < D * D; ++k) to[k] += entries[k][l];
    }
  }
  Block& block(std::int32_t slot) { return blocks_[to_size(slot)]; }
  const Block& block(std::int32_t slot) const { return blocks_[to_size(slot)]; }

  void set_zero(Workers& workers = Workers::none());
  void set_row_zero(std::size_t i);
  std::size_t block_count() const;                             ///< in use
  std::size_t slot_count() const { return columns_.slots(); }  ///< with those that rows have moved out of

  /// Before row_product() of a row that is some rows ahead.
  void prefetch_row(std::size_t i) const {
    prefetch(columns_[i].data(), columns_[i].size());
    prefetch(blocks_.data() + columns_.begin(i), columns_[i].size());
  }
  void prefetch_diagonal(std::size_t i) const { prefetch(blocks_.data() + columns_.begin(i), 1); }
  /// Row i times x, whose vertices have a Lanes each (spread()). D = 1: the entries times whole Lanes.
  Lanes row_product(std::size_t i, std::span<const Lanes> x) const {
    const Block* block = blocks_.data() + columns_.begin(i);
    if constexpr (D == 1) {
      // Two sums, so that additions don't wait for each other.
      const auto columns = columns_[i];
      const auto term = [&](std::size_t k) { return block[k](0) * x[to_size(columns[k])]; };
      Lanes sum{}, other{};
      std::size_t k = 0;
      for (; k + 2 <= columns.size(); k += 2) {
        sum += term(k);
        other += term(k + 1);
      }
      if (k < columns.size()) sum += term(k);
      return sum + other;
    } else {
      // Entries four by four, which belong to different rows: sorted out at the end.
      Lanes first{}, second{}, last{};
      for (const std::int32_t j : columns_[i]) {
        const Lanes at = x[to_size(j)];
        const double* const entries = (block++)->data();
        if constexpr (D == 2) first += load(entries) * __builtin_shufflevector(at, at, 0, 0, 1, 1);
        if constexpr (D == 3) {
          first += load(entries) * __builtin_shufflevector(at, at, 0, 0, 0, 1);
          second += load(entries + 4) * __builtin_shufflevector(at, at, 1, 1, 2, 2);
          last[0] += entries[8] * at[2];
        }
      }
      if constexpr (D == 2) return Lanes{first[0] + first[2], first[1] + first[3], 0, 0};
      return Lanes{first[0] + first[3] + second[2], first[1] + second[0] + second[3], first[2] + second[1] + last[0],
                   0};
    }
  }
  /// y += factor A x.
  void add_product(double factor, const Field& x, Field& y) const;

 private:
  GrowingRows<std::int32_t> columns_;
  std::vector<Block> blocks_;  // one for each slot of columns_
};

/// The D values of each vertex, then zeros.
template <int D>
void spread(const Field& x, std::vector<Lanes>& vertices, Workers& workers = Workers::none());

/// y += factor (A (x) I) x, for `dimension` values per vertex.
void add_product_per_coordinate(const BlockMatrix<1>& a, int dimension, double factor, const Field& x, Field& y,
                                Workers& workers = Workers::none());

/// Largest |entry|, and largest |entry| of the difference of two matrices with rows in any order of columns. They look
/// at everything: for tests, and outside the clock.
template <int D>
double max_entry(const BlockMatrix<D>& a);
template <int D>
double max_difference(const BlockMatrix<D>& a, const BlockMatrix<D>& b);

}  // namespace cutbench
