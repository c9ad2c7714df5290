// What the exact fields of cracks share (exact_fields.h): parts of complex potentials, in a solution's own frame.
#pragma once

#include <cmath>

#include "harness/problems/common/exact_fields.h"

namespace cutbench {

/// What counts as on the cut, in units of the sheet: far above rounding, far below everything else.
inline constexpr double on_the_cut = 1e-9;

/// A point on the x axis, moved to the side of it where `side` is by less than anything else can feel.
inline Complex beside_the_axis(Complex z, Complex side) {
  return std::abs(z.imag()) < on_the_cut ? Complex(z.real(), std::copysign(1e-300, side.imag())) : z;
}

/// The same stress everywhere.
inline Potentials uniform_potentials(const PlaneStress& stress, Complex z) {
  const double mean = (stress.xx + stress.yy) / 4;
  const Complex deviator((stress.yy - stress.xx) / 2, stress.xy);
  return {mean * z, mean, 0, deviator * z, deviator};
}

/// phi = k g, psi = conj(k) g - z phi', where g is real on the x axis ahead of the cut: what crosses the axis there is
/// s_yy - i s_xy = 2 k g', and nothing crosses it where g' is imaginary.
inline Potentials collinear_potentials(Complex z, Complex k, Complex g, Complex g_1, Complex g_2) {
  const Complex phi_1 = k * g_1, phi_2 = k * g_2;
  return {k * g, phi_1, phi_2, std::conj(k) * g - z * phi_1, std::conj(k) * g_1 - phi_1 - z * phi_2};
}

inline Potentials operator+(const Potentials& a, const Potentials& b) {
  return {a.phi + b.phi, a.phi_1 + b.phi_1, a.phi_2 + b.phi_2, a.psi + b.psi, a.psi_1 + b.psi_1};
}

}  // namespace cutbench
