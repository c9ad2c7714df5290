// A strip cut out of a sheet, free: how fast it swings and spins, whatever a method made of its mass.
#pragma once

#include <memory>

#include "harness/problems/common/problem.h"

namespace cutbench {

/// Length L and width b, without Poisson's effect, so that it bends as a beam. The first bending of a free beam:
///   w^2 = (4.7300)^4 D / (rho L^4),  X = cosh k s + cos k s - 0.9825 (sinh k s + sin k s),  k = 4.7300 / L
/// (Rayleigh, The Theory of Sound, 170 ff.; not read, the constants are solved for in tests/free_strip_test.cpp). The
/// next, a twist, has twice that frequency. Solved for as the smallest eigenvalue of bending against the masses that
/// move a sheet, of the modes across the rest plane, by inverse iteration.
///
/// frequency: w. mode: part of the computed shape that isn't the exact one, by the masses: the sine between them. spin:
/// a piece with a given angular momentum turns at the inverse of its moment of inertia, here of
/// rho L b (L^2 + b^2) / 12.
std::unique_ptr<const Problem> free_strip();

}  // namespace cutbench
