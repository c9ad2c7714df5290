// What conjugate gradients are told of a system beyond its diagonal blocks.
#pragma once

#include <vector>

#include "harness/fem/linear/system_matrix.h"

namespace cutbench {

template <int D>
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// `a` must outlive the calls of apply().
  virtual void setup(const SystemMatrix<D>& a) = 0;
  /// The same for one that already has the blocks on the diagonal, as a.diagonals() gives them.
  using Blocks = std::vector<typename BlockMatrix<D>::Block>;
  virtual void setup(const SystemMatrix<D>& a, const Blocks& /*diagonals*/) { setup(a); }
  /// Solves A x = b exactly where nothing links to the rest, if it can, and sets the residual r to zero there.
  /// \pre b is zero where unknowns are held
  virtual void solve_apart(const Field& /*b*/, Field& /*x*/, Field& /*r*/) {}
  /// z = B r, with B symmetric and positive definite. On entry z holds the residual times the inverse diagonal blocks.
  /// \pre r is zero where unknowns are held or solved apart. Then z is, too.
  virtual void apply(const Field& r, Field& z) = 0;
  /// y = A x at least as exactly as floats are, and sooner than by `a`; or false, and nothing is done. Where unknowns
  /// are held or solved apart, y is zero.
  virtual bool multiply_roughly(const Field& /*x*/, Field& /*y*/) { return false; }
};

}  // namespace cutbench
