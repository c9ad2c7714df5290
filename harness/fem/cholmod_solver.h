// Direct solution: supernodal Cholesky factorisation by CHOLMOD (Chen, Davis, Hager and Rajamanickam, ACM TOMS 35(3),
// 2008) in METIS ordering (Karypis and Kumar, SIAM J. Sci. Comput. 20(1), 1998), on one thread.
#pragma once

#include <memory>

#include "harness/fem/linear_solver.h"

namespace cutbench {

/// The analysis (pattern, ordering, symbolic factor) is kept for as long as the pattern and the held unknowns of the
/// matrices given to setup() stay the same. A matrix that is not positive definite is reported by solve(): not
/// converged, x = 0.
template <int D>
std::unique_ptr<LinearSolver<D>> make_cholmod_solver();

}  // namespace cutbench
