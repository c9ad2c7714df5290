// Vertex block descent: backward Euler's step as a minimum, sought vertex by vertex without a matrix (Chen, Liu, Yang
// and Yuksel, Vertex block descent, ACM Transactions on Graphics 43(4), 2024; read in its abstract and public
// summaries).
//
//   x = argmin (1 + h alpha) (x - y)' M (x - y) / (2 h^2) + E(x),   y = x0 + h v0 + h^2 a, without inner forces
//
// A sweep takes the vertices one by one, and each to the minimum of a quadratic in its own place, H dx = f: of the
// elements round it H has the positive semi-definite part of the second derivative (membrane.h), so that f goes
// downhill. Stiffness damping beta adds beta / h times each element's G^T S G (x - x0), as in xpbd.h. The sweeps begin
// at x0 + h v0 + h^2 a', with as much of the outer acceleration as the vertex had in its last step, none to all of it:
// what hangs still begins where it hangs. Without their acceleration by Chebyshev's polynomials, whose radius is to be
// tuned, and without threads.
#pragma once

#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
class VertexBlockDescent {
 public:
  /// \param x0  m: at the begin of a step of h seconds
  /// \param y   m: where the step leads without inner forces
  /// \param x   m: where the sweeps begin; then where the step leads
  /// \pre no constrained vertices, each triangle an element, lumped mass
  void solve(const Model<D>& model, double h, int sweeps, const Field& x0, const Field& y, Field& x) const;
};

}  // namespace cutbench
