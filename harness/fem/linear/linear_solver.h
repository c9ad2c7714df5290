// Solvers of the symmetric positive definite system of one step, behind one interface. Each reports what it reached; a
// solve that did not converge is never published as a time.
#pragma once

#include <memory>

#include "harness/fem/linear/solver_options.h"
#include "harness/fem/linear/system_matrix.h"

namespace cutbench {

struct SolveReport {
  int iterations = 0;   ///< 0 for a direct solver
  double residual = 0;  ///< |b - A x| / |b| with the true residual, computed anew from x; 0 where b is 0
  /// residual <= tolerance, and that of the equilibrated system, |b - A x| in the norm of the inverse diagonal blocks;
  /// all finite. Direct: residual <= 1e-8, or a backward error at the level of rounding.
  bool converged = false;
  bool fell_back = false;  ///< the preconditioner gave up, now or lately, and the next took its place
};

template <int D>
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Preconditioner or factorisation. `a` must outlive the solves.
  virtual void setup(const SystemMatrix<D>& a) = 0;
  /// Solves A x = b. Held unknowns of x come out zero, whatever b says of them.
  /// \param start  an estimate of x, zero where unknowns are held, for solvers that iterate; where it has another size
  /// or
  ///               is no better than zero, they start from zero
  virtual SolveReport solve(const Field& b, Field& x, const Field& start = {}) = 0;
};

}  // namespace cutbench
