// A stretched strip that is cut right across: the one problem in motion with an exact answer. SI units.
//
// The unit square has E = 1 N/m, density 1 kg/m2 and nu = 0, so that c = sqrt(E / density) = 1 m/s, and strains are
// linear. It rests between two clamps, stretched by eps along x. At t = 0 it is cut along x = a, without loss and in no
// time. As nothing pulls sideways and nu = 0, each piece moves as a bar of length L = a or 1 - a, clamped at one end
// and free at the other (Graff, Wave Motion in Elastic Solids, 1975, chapter 2: d'Alembert's solution and its
// reflections): a wave with no stress behind it leaves the lip with speed c, is at the clamp at L / c, where the stress
// returns as pressure, and back at 2 L / c. The lip moves with the speed eps c until then, and turns. Its displacement
// is a triangle wave with amplitude eps L and period 4 L / c about that of a bar at ease.
#pragma once

#include "harness/fem/elements/physics.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

/// Displacement of the free end of the bar, m, from where it is at ease; positive stretches it. \param strain  before
/// the release; length in m, time in s, not negative; the wave's speed is 1 m/s.
double released_end(double strain, double length, double time);

/// `severed_strip_<integrator>`. \param step  in units of 1 / (n c), the time in which a wave passes one square of the
/// specimen's sheet. \pre `integrator` is implicit and makes steps.
std::unique_ptr<const Problem> severed_strip(Integrator integrator, double step = 1);

}  // namespace cutbench
