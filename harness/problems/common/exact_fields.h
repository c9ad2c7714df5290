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

// --- exact_cracks.cpp ------------------------------------------------------------------------------------------------

/// Straight cuts of length 2 a along the x axis, their middles a period W apart, one at the origin, without end, in an
/// infinite plate under a stress far away. The uniform field, and phi = (yy - i xy) / 2 (g - z) with
///   g' = sin(p z) / X,  g = -i/p log((cos(p z) + i X) / cos(p a)),  X = sqrt(sin^2(p z) - sin^2(p a)),  p = pi / W.
/// K1 = yy sqrt(W tan(pi a / W)), K2 likewise; the gape is 4 yy W / (pi E) arcosh(cos(pi x / W) / cos(pi a / W)).
/// Source: Westergaard, Bearing pressures and cracks, J. Appl. Mech. 6 (1939); Koiter, Ing.-Arch. 28 (1959); neither
/// was read. The tests check lips, period, K and gape.
ElasticField collinear_cracks_field(const Elastic& elastic, const Axes& frame, double a, double period,
                                    const PlaneStress& far_away);

/// What loads the lips of a straight cut, N/m: `even` + `odd` x / a, `normal` as a pressure that opens it, `shear`
/// along x on the lip above. The other lip is loaded in the other direction.
struct LipLoad {
  struct Line {
    double even = 0, odd = 0;
  };
  Line normal, shear;
  /// On the lip above, in the cut's frame; nothing beyond the ends.
  Eigen::Vector2d above(double x, double a) const;
};

/// A straight cut from -a to a along the x axis of an infinite plate, under a load on its lips alone: phi' of
///   even / 2 (z / X - 1) + odd / 2 ((2 z^2 - a^2) / (2 a X) - z / a),  X = sqrt(z^2 - a^2),
/// where even and odd are normal - i shear.
/// K1 = (even +- odd / 2) sqrt(pi a) at the ends +-a.
/// Source: Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook, part II; not read. The tests check lips and
/// K.
ElasticField loaded_crack_field(const Elastic& elastic, const Axes& frame, double a, const LipLoad& load);

/// Two straight cuts of length 2 a that cross in their middles, along both axes, pulled by `stress` in all directions.
/// Each is a sum of the fields of the pressures U_n(x / a) on the lips of a lone cut, n even, whose phi' is
///   w^(n + 1) / (2 X),  w = z / a - X,  X = sqrt((z / a)^2 - 1);
/// the factors make the lips free, by collocation. Equilibrium is exact, and what is left on the lips is within 1e-4 of
/// the stress. K1 = 0.8635 s sqrt(pi a), computed here; Rooke and Sneddon, Int. J. Eng. Sci. 7 (1969), have 0.8636,
/// by an integral equation (not read; as Murakami's and other handbooks quote it).
ElasticField crossed_cracks_field(const Elastic& elastic, const Axes& frame, double a, double stress);
/// K1 of these, over stress sqrt(pi a).
double crossed_cracks_factor();

// --- exact_cut_outs.cpp ----------------------------------------------------------------------------------------------

/// A corner of the sheet's angle 2 h > pi, from -h to h round the x axis, with free sides, and the first term at its
/// point: phi = A z^q, psi = B z^q. Opening: sin 2 q h + q sin 2 h = 0, with real A and B = -A (cos 2 q h + q cos 2 h);
/// sliding: sin 2 q h = q sin 2 h, with imaginary A and B = A (cos 2 q h - q cos 2 h). On the x axis s_yy, or s_xy of
/// sliding, is stress x^(q - 1). Beyond the sides the field is continued, up to the negative x axis.
/// Source: Williams, Stress singularities resulting from various boundary conditions in angular corners of plates in
/// extension, J. Appl. Mech. 19 (1952); not read. The tests check the sides.
struct Corner {
  double half_angle;  ///< h, radians
  bool sliding = false;
  /// q: of an opening corner of 270 degrees 0.5445, of a sliding one 0.9085.
  double exponent() const;
};
ElasticField corner_field(const Elastic& elastic, const Axes& frame, const Corner& corner, double stress);

/// An ellipse round the origin, its axes along x and y. z = R (t + m / t), R = (a + b) / 2, m = (a - b) / (a + b), maps
/// the outside of the unit circle to its outside.
struct Ellipse {
  double a, b;  ///< half axes, a > b
  double mean() const { return (a + b) / 2; }
  double ratio() const { return (a - b) / (a + b); }
  /// t; inside 1 in its magnitude where z is in the ellipse.
  Complex to_circle(Complex z) const;
  Complex from_circle(Complex t) const { return mean() * (t + ratio() / t); }
  bool holds(Complex z) const { return std::abs(to_circle(z)) < 1; }
};

/// An elliptic hole in an infinite plate under a stress far away. With M = (xx + yy) / 4, D = (yy - xx) / 2 + i xy:
///   phi = R (M t - (conj D + M m) / t),
///   psi = R (D t - conj D (1 + m t^2) / (t (t^2 - m)) - 2 M (1 + m^2) t / (t^2 - m)).
/// Pulled by s along y the hoop stress is s (1 + 2 a / b) at the ends of the long axis. There is nothing in the hole:
/// at a point in it the field is that of the rim, at the same angle of t.
/// Source: Inglis, Trans. Inst. Naval Arch. 55 (1913); Muskhelishvili 1953; neither was read. The tests check the rim
/// and Inglis's stress.
ElasticField elliptic_hole_field(const Elastic& elastic, const Axes& frame, const Ellipse& ellipse,
                                 const PlaneStress& far_away);

}  // namespace cutbench
