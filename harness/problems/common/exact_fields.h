// The exact fields: infinite plates with a cut or a hole in them, after Muskhelishvili (elastic_field.h).
#pragma once

#include "harness/problems/common/elastic_field.h"

namespace cutbench {

/// N/m, in the axes of a field's frame.
struct PlaneStress {
  double xx = 0, yy = 0, xy = 0;
};

/// Stress intensity factors: N/m of stress per thickness, times sqrt(m).
struct StressIntensity {
  double k1 = 0, k2 = 0;
};

/// The same stress everywhere.
ElasticField uniform_field(const Elastic& elastic, const Axes& frame, const PlaneStress& stress);

/// The first term at the tip of a long cut along the negative x axis (Williams 1957): stresses K / sqrt(2 pi x) ahead
/// of it. phi = (K1 - i K2) sqrt(z / 2 pi).
ElasticField williams_field(const Elastic& elastic, const Axes& frame, const StressIntensity& k);

/// A straight cut from -a to a along the x axis of an infinite plate under a stress far away: the uniform field, and
/// phi = (yy - i xy) / 2 (sqrt(z^2 - a^2) - z). K1 = yy sqrt(pi a), K2 = xy sqrt(pi a) at both ends.
ElasticField straight_crack_field(const Elastic& elastic, const Axes& frame, double a, const PlaneStress& far_away);

/// A cut along the arc R exp(i t), |t| <= A < pi, of an infinite plate under a stress far away. With z in units of R,
/// X = sqrt(z^2 - 2 z cos A + 1), G = (xx + yy) / 4 and g = (yy - xx) / 2 - i xy:
///   phi = (C X + D z - g (X + 1) / z) / 2,  psi = conj(omega(1 / conj z)) - phi' / z,
///   omega = (C X - D z - g (X - 1) / z) / 2,  D = 2 G - C.
/// By the method of Muskhelishvili's chapter 124: phi' + omega' is (a polynomial of z and 1/z) / X, phi' - omega' is
/// rational; phi is regular at 0 and psi, too, which gives
///   Re C = (4 G + Re g sin^2 A / 2) / (3 - cos A),  Im C = -Im g sin^2 A / (2 (1 + cos A)).
ElasticField arc_crack_field(const Elastic& elastic, const Axes& frame, double radius, double half_angle,
                             const PlaneStress& far_away);

/// Of an arc under the stress s in all directions, and under s along its axis of symmetry: at the end at exp(i A), in
/// the frame of the tangent; at the other end K2 has the other sign. Handbook formulas (Tada, Paris and Irwin), not
/// taken from the potentials above.
StressIntensity arc_intensity_all_round(double radius, double half_angle, double stress);
StressIntensity arc_intensity_along_axis(double radius, double half_angle, double stress);

/// A round hole in an infinite plate pulled by s along the x axis (Kirsch 1898).
ElasticField hole_field(const Elastic& elastic, const Axes& frame, double radius, double stress);

}  // namespace cutbench
