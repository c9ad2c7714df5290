// The matrix of one linear solve: D x D blocks, scalar matrices that act on each coordinate alike (bending, consistent
// mass), and the unknowns that are held. Held unknowns are left out by projection, so no entry is changed for them.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/algebra/pattern_history.h"
#include "harness/fem/algebra/strong_couplings.h"
#include "harness/fem/algebra/workers.h"
#include "harness/mesh/types.h"

namespace cutbench {

template <int D>
struct SystemMatrix {
  struct ScalarTerm {
    double factor;
    const BlockMatrix<1>* matrix;
  };
  const BlockMatrix<D>* blocks = nullptr;
  std::vector<ScalarTerm> scalar;                   ///< none where a scene has no bending
  const std::vector<std::uint8_t>* held = nullptr;  ///< per unknown: 1 where its value is given, or its vertex is freed
  const CoupledElements* elements = nullptr;        ///< for preconditioners that look at shapes
  const std::vector<Point2>* places = nullptr;      ///< of the vertices in rest space; NaN where that is not known
  /// Changes whenever the pattern of a part or the values of a scalar matrix changed; unique in the program.
  std::uint64_t pattern = 0;
  const PatternHistory* history = nullptr;  ///< which rows changed when, where that is known; its last is `pattern`

  std::size_t vertices() const { return blocks->rows(); }
  /// y += A x, for all unknowns alike.
  void add_product(const Field& x, Field& y, Workers& workers = Workers::none()) const;
  /// y = A x, zero where held. \pre x is zero there.
  void multiply(const Field& x, Field& y, Workers& workers = Workers::none()) const;
  /// The block on the diagonal of row i; a held unknown has 1 there and zeros beside it.
  typename BlockMatrix<D>::Block diagonal(std::size_t i) const;
  void diagonals(std::vector<typename BlockMatrix<D>::Block>& all,
                 Workers& workers = Workers::none()) const;  ///< of all rows

 private:
  template <class Take>
  void for_each_product(const Field& x, Workers& workers, const Take& take) const;
  mutable std::vector<Lanes> x_;  // working storage of the products, so they are not for two callers at a time
};

/// For solvers: b with zeros where unknowns are held.
void project(const std::vector<std::uint8_t>& held, const Eigen::Ref<const Field>& b, Field& projected);

}  // namespace cutbench
