// The rows of the matrix of one level of a multigrid hierarchy. What a cut touches is rewritten row by row.
#pragma once

#include <span>
#include <vector>

#include "harness/fem/algebra/growing_rows.h"

namespace cutbench {

/// Rows of column numbers in the order of the sweeps: first those below the row's own, then its own, then those above.
class SweepRows {
 public:
  SweepRows() = default;
  SweepRows(const SweepRows&) = default;
  SweepRows(SweepRows&&) = default;
  SweepRows& operator=(const SweepRows&) = default;
  SweepRows& operator=(SweepRows&&) = default;
  ~SweepRows() {}  // NOLINT: clang 14 calls one that is defaulted, and does not emit it (WebAssembly)

  std::size_t size() const { return columns_.size(); }
  void resize(std::size_t rows) {
    columns_.resize(rows);
    below_.resize(rows);
  }
  void reserve_spare() {
    columns_.reserve_spare();
    cutbench::reserve_spare(below_);
  }
  struct Placed {
    std::span<const std::int32_t> order;  ///< for each entry of the row, its place among the columns that were given
    bool is_new;                          ///< the row was another before
  };
  /// Gives row i these columns, each once and i among them, or none. The result is valid until the next call.
  Placed set(std::size_t i, std::span<const std::int32_t> columns);
  /// The same for columns in the order of the sweeps, of which `below` are below i.
  void set_in_order(std::size_t i, std::span<const std::int32_t> columns, std::size_t below) {
    columns_.set(i, columns);
    below_[i] = static_cast<std::uint32_t>(below);
  }

  std::span<const std::int32_t> operator[](std::size_t i) const { return columns_[i]; }
  std::span<const std::int32_t> below(std::size_t i) const { return columns_[i].first(below_[i]); }
  /// \pre the row is not empty
  std::span<const std::int32_t> above(std::size_t i) const { return columns_[i].subspan(below_[i] + 1); }
  /// Slots are for values kept beside the rows. Those of a row follow each other.
  std::size_t first_slot(std::size_t i) const { return columns_.begin(i); }
  std::size_t diagonal_slot(std::size_t i) const { return columns_.begin(i) + below_[i]; }
  std::size_t slots() const { return columns_.slots(); }

 private:
  GrowingRows<std::int32_t> columns_;
  std::vector<std::uint32_t> below_;
  std::vector<std::int32_t> order_, ordered_;
};

/// Rows of a level, as those of the next coarser one are made of them.
struct FineRows {
  const SweepRows &blocks, &scalars;
  const std::vector<double>& scalar;  // per slot of `scalars`
  std::size_t size() const { return blocks.size(); }
};

/// D x D blocks, which couple neighbours, and scalars that act on each coordinate alike, which reach farther. The
/// scalars are constant between changes of the rows; the blocks' values are kept elsewhere.
struct LevelRows {
  SweepRows blocks, scalars;
  std::vector<double> scalar;  // per slot of `scalars`

  operator FineRows() const { return {blocks, scalars, scalar}; }
  std::size_t size() const { return blocks.size(); }
  void resize(std::size_t rows) {
    blocks.resize(rows);
    scalars.resize(rows);
  }
  /// Room to grow by half, before anything has to be copied.
  void reserve_spare() {
    blocks.reserve_spare();
    scalars.reserve_spare();
    cutbench::reserve_spare(scalar);
  }
  /// True if the row was another before.
  bool set_scalars(std::size_t i, std::span<const std::int32_t> columns, std::span<const double> values);
};

/// What is different since the last time.
struct RowChanges {
  std::vector<std::int32_t> rows;   ///< rows with other columns or scalars
  std::vector<std::int32_t> links;  ///< unknowns that blocks link to others than before, or whose place is another
};

}  // namespace cutbench
