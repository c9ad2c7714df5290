// When a direct solve counts as converged.
#pragma once

namespace cutbench {

/// As good as it can be: a residual |b - A x| / |b| of 1e-8, or a backward error at the level of rounding (Higham,
/// Accuracy and Stability of Numerical Algorithms, 2002, 7.1). On slivers the residual may be far from rounding level.
/// \param largest  entry of A, by size, which no norm of A is below
inline bool is_direct_solution(double residual, double b_norm, double largest, double x_norm) {
  constexpr double accepted_residual = 1e-8, accepted_backward_error = 1e-12;
  return residual <= accepted_residual || residual * b_norm <= accepted_backward_error * largest * x_norm;
}

}  // namespace cutbench
