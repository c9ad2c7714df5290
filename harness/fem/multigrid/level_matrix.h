// The matrix of one level of a multigrid hierarchy, with the sweeps of its smoother: Gauss-Seidel by the blocks of the
// unknowns, forwards before the coarse correction and backwards after it, so that the whole cycle is symmetric
// (Trottenberg, Oosterlee and Schueller, Multigrid, 2001, 2.5 and 2.7.2).
//
// Bending couples each vertex to some 35 others, most of them hardly at all. So the sweeps are those of a matrix A
// without the small scalars. These are added to its diagonal, and a row times a translation stays what it was. Coarser
// levels are made from all scalars. With a sweep forwards W and a coarse correction C, the cycle is
// (W + W' - W' A W) + (I - W' A) C (I - A W), and W + W' - W' A W = W' (diagonal of A) W. So it is symmetric, and
// positive definite where C and the blocks on the diagonal of A are.
#pragma once

#include <Eigen/Core>

#include "harness/fem/multigrid/level_rows.h"

namespace cutbench {

/// Symmetric, of D x D blocks and of scalars that act on each coordinate alike. S: float, or double where floats would
/// not do. Vectors have D values per row, and room for `padding` more, which single wide loads may read.
template <int D, class S>
class LevelMatrix {
 public:
  static constexpr std::size_t padding = 4;
  using Vector = std::vector<S>;

  /// Takes the scalars of these rows that are not small, and has room for the blocks of all. `rows` must outlive it,
  /// and stay where it is.
  void follow(const LevelRows& rows, std::span<const std::int32_t> changed);
  void follow(const LevelRows& rows);  ///< all rows, with room to grow by half
  std::size_t size() const { return rows_->size(); }
  const LevelRows& rows() const { return *rows_; }
  /// Scalars that the sweeps take.
  std::size_t scalar_count() const;
  /// D x D values of a slot of the block rows, column by column.
  S* block(std::size_t slot) { return blocks_.data() + D * D * slot; }
  const S* block(std::size_t slot) const { return blocks_.data() + D * D * slot; }

  /// Calls visit(column, value) for the entries of row i.
  template <class Visit>
  void for_each_block(std::size_t i, const Visit& visit) const {
    const S* values = block(rows_->blocks.first_slot(i));
    for (const std::int32_t j : rows_->blocks[i]) {
      visit(j, Eigen::Map<const Eigen::Matrix<S, D, D>>(values));
      values += D * D;
    }
  }
  /// Without the small ones.
  template <class Visit>
  void for_each_scalar(std::size_t i, const Visit& visit) const {
    std::size_t slot = near_.first_slot(i);
    for (const std::int32_t j : near_[i]) visit(j, scalars_[slot++]);
  }

  using Block = Eigen::Matrix<double, D, D>;
  /// What A has more on the diagonal of row i: the sum of its small scalars.
  double left_out(std::size_t i) const { return left_out_[i]; }
  /// The block on the diagonal of row i of A. \pre the row is not empty
  Block diagonal(std::size_t i) const;
  Eigen::MatrixXd dense() const;  ///< with all scalars
  /// The inverse of the block on the diagonal of row i, zero in rows and columns of held coordinates.
  void set_inverse(std::size_t i, const Block& inverse) {
    Eigen::Map<Eigen::Matrix<S, D, D>>(inverse_.data() + D * D * i) = inverse.template cast<S>();
  }

  /// z = (L + diagonal)^-1 r and t = r - A z, which is what the upper triangle leaves.
  void sweep_forwards(const Vector& r, Vector& z, Vector& t) const;
  /// z += (U + diagonal)^-1 (r - A z).
  void sweep_backwards(const Vector& r, Vector& z) const;

 private:
  using Columns = std::span<const std::int32_t>;
  using Sum = Eigen::Array<S, 4, 1>;
  void find_scales(std::span<const std::int32_t> changed);
  void take_scalars(std::size_t i);
  void prefetch_row(std::size_t i) const;
  void subtract_blocks(std::size_t slot, Columns columns, const Vector& z, Sum& sum) const;
  void subtract_scalars(std::size_t slot, Columns columns, const Vector& z, Sum& sum) const;
  void subtract_below(std::size_t i, const Vector& z, Sum& sum) const;
  void subtract_above(std::size_t i, const Vector& z, Sum& sum) const;
  Sum times_inverse(std::size_t i, const Sum& residual) const;

  const LevelRows* rows_ = nullptr;
  SweepRows near_;             // columns of the scalars that are not small
  Vector blocks_, scalars_;    // per slot, of rows_->blocks and of near_
  std::vector<double> scale_;  // per row: what its scalars are compared with; 0 where it is empty
  double median_scale_ = 0;
  std::vector<double> left_out_;  // per row: the sum of its small scalars
  Vector inverse_;
  std::vector<std::int32_t> columns_;  // working storage of take_scalars(), with the next
  std::vector<S> values_;
};

}  // namespace cutbench
