// A sheet hangs at rest and is cut from the side: the part below the cut drops and swings. SI units.
//
// The unit square has E = 1 N/m, density 1 kg/m2 and nu = 0, so that waves of stretch run at 1 m/s, and strains are
// linear. Its upper side is held. It hangs in equilibrium, u_y = -g (1 - y^2) / 2 (a bar under its own weight), with g
// = 0.1 m/s2. At t = 0 a straight cut runs from the right side into the sheet, without loss and in no time. Cut sheets
// begin with the displacement that the uncut one's elements have there.
//
// There is no closed form for what follows. It is compared with the same motion on two meshes that are fitted to the
// cut and finer (body_fitted()), by the same integrator with the same step: the error is that of the cut sheet alone.
// The tip makes it go like the size h of the triangles (Strang and Fix, An analysis of the finite element method, 1973,
// chapter 8), so the two are extrapolated to h = 0: 2 q(h / 2) - q(h).
//
// Measures, over all steps: of the displacement of the lower right corner, of the gape at eight places of the cut, and
// of the strain energy, the root of the mean square of the difference over that of the truth; and the energy lost until
// the end, over the largest kinetic energy of the truth.
#pragma once

#include "harness/fem/elements/physics.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

/// Displacement of the uncut sheet at rest, m, at the height `y` above the lower side.
double hanging_displacement(double y);

/// `hanging_sheet_<integrator>`. A step is the time in which a wave of stretch passes one square of the specimen's
/// sheet. \param duration  s \param fine      of the finest mesh: it has 2 fine^2 triangles, nearly; even \pre
/// `integrator` is implicit and makes steps.
std::unique_ptr<const Problem> hanging_sheet(Integrator integrator, double duration = 4, int fine = 128);

}  // namespace cutbench
