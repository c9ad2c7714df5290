// The matrix of one level of a multigrid hierarchy, with the sweeps of its smoother: Gauss-Seidel by the blocks of the
// unknowns, forwards before the coarse correction and backwards after it, so that the whole cycle is symmetric
// (Trottenberg, Oosterlee and Schueller, Multigrid, 2001, 2.5 and 2.7.2).
#pragma once

#include <Eigen/Core>

#include "harness/fem/coarsening.h"

namespace cutbench {

/// Symmetric, of D x D blocks and of scalars that act on each coordinate alike. S: float, or double where floats would
/// not do. Vectors have D values per row, and room for `padding` more, which single wide loads may read.
template <int D, class S>
class LevelMatrix {
 public:
  static constexpr std::size_t padding = 4;
  using Vector = std::vector<S>;

  /// Takes the rows, which hold their diagonals unless they are empty. Values are zero.
  void set_pattern(const SparseRows& blocks, const SparseRows& scalars);
  std::size_t size() const { return blocks_.rows.size(); }
  const SparseRows& block_rows() const { return blocks_.rows; }
  const SparseRows& scalar_rows() const { return scalars_.rows; }
  /// D x D values of an entry of the block rows, column by column.
  S* block(std::size_t entry) { return blocks_.value.data() + D * D * entry; }
  const S* block(std::size_t entry) const { return blocks_.value.data() + D * D * entry; }
  S& scalar(std::size_t entry) { return scalars_.value[entry]; }

  using Block = Eigen::Matrix<double, D, D>;
  /// The block on the diagonal of row i, with its scalar. \pre the row is not empty
  Block diagonal(std::size_t i) const;
  Eigen::MatrixXd dense() const;
  /// The inverse of the block on the diagonal of row i, zero in rows and columns of held coordinates.
  void set_inverse(std::size_t i, const Block& inverse) {
    Eigen::Map<Eigen::Matrix<S, D, D>>(inverse_.data() + D * D * i) = inverse.template cast<S>();
  }

  /// z = (L + diagonal)^-1 r and t = r - A z, which is what the upper triangle leaves.
  void sweep_forwards(const Vector& r, Vector& z, Vector& t) const;
  /// z += (U + diagonal)^-1 (r - A z).
  void sweep_backwards(const Vector& r, Vector& z) const;

 private:
  struct Part {
    SparseRows rows;
    std::vector<std::int32_t> diagonal;  // per row: the entry on the diagonal, or where the row begins if it is empty
    Vector value;
  };
  static void set_pattern(const SparseRows& rows, std::size_t values, Part& part);
  using Sum = Eigen::Array<S, 4, 1>;
  void subtract_blocks(std::int32_t first, std::int32_t last, const Vector& z, Sum& sum) const;
  void subtract_scalars(std::int32_t first, std::int32_t last, const Vector& z, Sum& sum) const;
  void relax(std::size_t i, const Sum& residual, Vector& z) const;

  Part blocks_, scalars_;
  Vector inverse_;
};

}  // namespace cutbench
