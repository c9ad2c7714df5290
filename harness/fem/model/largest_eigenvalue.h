// How stiff the worst spot of a sheet is: what bounds the step of an explicit integrator, and what an iterative solver
// suffers from. One sliver is enough, so that this tells shapes apart that means over triangles do not.
#pragma once

#include "harness/fem/elements/physics.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// What the sheet is made of, but for factors of time and mass.
struct Elasticity {
  double poisson = 0.3;
  Plane plane = Plane::stress;
  BendingKind bending = BendingKind::none;
  double bending_length2 = 0;  ///< D / (E h): rigidity over stiffness, area; t^2 / (12 (1 - nu^2)) of a plate t thick
  Mass mass = Mass::lumped;    ///< consistent is not taken
  /// Of a mass that is stabilised or scaled: the largest eigenvalue of an element (added_mass.h), 1/area, such as that
  /// of largest_element_eigenvalue() of the uncut sheet.
  double mass_limit = 0;
};

/// Of any element, 1/area, as added_mass.h bounds it: no less than largest_eigenvalue() without bending.
double largest_element_eigenvalue(const Sheet& sheet, const Elasticity& elasticity = {});

/// What an added mass makes the sheet heavier against translation, over its mass.
double added_mass_share(const Sheet& sheet, const Constraints& constraints, const Elasticity& elasticity);

/// The largest eigenvalue of K u = lambda M u, 1/area, for E h = 1 and a mass of 1 per area, lumped with what is added:
/// K the linear stiffness of membrane and bending of the opened sheet in its rest plane, nothing held. Membranes
/// stiffen with 1/length^2, bending with 1/length^4. A bent sheet's may differ: that of a turned triangle is the same,
/// but that of its neighbours is turned otherwise. Where vertices are constrained, x = C q, it is that of C^T K C and
/// C^T M C with their ghost penalties, a mass that is not lumped any more unless the constraints say how. By Lanczos'
/// method on L^-1 K L^-T with M = L L^T (Golub and Van Loan, Matrix Computations, chapter 10), from a start that is
/// always the same, until the residual of the Ritz pair is below 1e-3 lambda at two checks: some eigenvalue is then
/// within that, and in practice the largest is within its square. Looks at everything: outside the clock. 0 for a sheet
/// without triangles, NaN where the mass is not positive.
double largest_eigenvalue(const Sheet& sheet, const Constraints& constraints = {}, const Elasticity& elasticity = {});

/// The largest stable step of symplectic Euler, s. A mode with w^2 = lambda E h / density and the damping c = alpha +
/// beta w^2, v+ = v - h (w^2 x + c v), x+ = x + h v+, is stable while h^2 w^2 + 2 h c <= 4 (the roots of z^2 - (2 - h c
/// - h^2 w^2) z + 1 - h c): up to 2 / w without damping. \param eigenvalue  lambda, of largest_eigenvalue()
double explicit_step_limit(double eigenvalue, const Material& material);

}  // namespace cutbench
