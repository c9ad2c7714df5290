// How stiff the worst spot of a sheet is: what bounds the step of an explicit integrator, and what an iterative solver
// suffers from. One sliver is enough, so that this tells shapes apart that means over triangles do not.
#pragma once

#include "harness/mesh/sheet.h"
#include "harness/mesh/ties.h"

namespace cutbench {

/// The largest eigenvalue of K u = lambda M u, 1/s2: K the linear membrane stiffness of the opened sheet in its rest
/// plane (plane stress, E h = 1 N/m, nu = 0.3, nothing held), M the lumped mass (1 kg/m2). It goes with 1/length^2, so
/// that only its ratio to another sheet's means something; the largest stable step of symplectic Euler is
/// 2 / sqrt(lambda). Where vertices are tied, x = C q, it is that of C^T K C and C^T M C with their ghost penalties, a
/// mass that is not lumped any more unless the ties say how. By Lanczos' method on L^-1 K L^-T with M = L L^T (Golub
/// and Van Loan, Matrix Computations, chapter 10), from a start that is always the same, until the residual of the Ritz
/// pair is below 1e-3 lambda at two checks: some eigenvalue is then within that, and in practice the largest is within
/// its square. Looks at everything: outside the clock. 0 for a sheet without triangles, NaN where the mass is not
/// positive.
double largest_eigenvalue(const Sheet& sheet, const Ties& ties = {});

}  // namespace cutbench
