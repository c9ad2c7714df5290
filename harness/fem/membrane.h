// The constant-strain membrane triangle, linear or co-rotational, in the plane or in space.
//
// With F = sum x_k (x) g_k (D x 2), F = R S its polar decomposition (S symmetric 2 x 2) and e = S - I, the energy per
// rest area is mu e:e + lambda/2 (tr e)^2, isotropic in the singular values of F. Its first Piola stress is P = R s
// with s = 2 mu e + lambda (tr e) I, exactly: the change of R does no work. Its second derivative splits into modes
// (Smith, de Goes and Kim, Analytic eigensystems for isotropic distortion energies, TOG 38, 2019): stretch and shear,
// where it is that of linear elasticity turned by R; the in-plane twist, with (s1 + s2) / (S1 + S2); and, in space,
// tilting out of the plane, with s_k / S_k along each principal direction (Baraff and Witkin's geometric stiffness).
// The last three can be negative under compression and are then left out, so the matrix is positive semi-definite, or
// kept, or all left out: StressStiffness says which.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "harness/fem/block_matrix.h"
#include "harness/fem/element_table.h"
#include "harness/fem/physics.h"

namespace cutbench {

/// Lame parameters per thickness, N/m.
struct Lame {
  double mu, lambda;
};
/// Plane stress: lambda = E nu / (1 - nu^2); plane strain: E nu / ((1 + nu)(1 - 2 nu)).
Lame lame_of(const Material& material, Plane plane);

/// How one triangle is deformed.
template <int D>
struct Deformation {
  Eigen::Matrix<double, D, 2> rotation;  ///< R: orthonormal columns, also where the triangle has collapsed
  Eigen::Matrix2d stretch;               ///< S, symmetric
  Eigen::Matrix2d stress;                ///< s, N/m
  double energy;                         ///< N/m: per rest area
};

/// R by its columns, and S, of one triangle or of several side by side (lanes.h).
template <int D, class Number>
struct Polar {
  std::array<std::array<Number, D>, 2> rotation;
  Number xx, xy, yy;  ///< of S
};

/// With gradient F, of any shape, also a collapsed one.
template <int D>
Deformation<D> deformation_of(const Eigen::Matrix<double, D, 2>& f, Strain strain, const Lame& lame);
/// For every shape, collapsed triangles included. \pre x has the vertices of `element`.
template <int D>
Deformation<D> deformation_of(const Element& element, const Field& x, Strain strain, const Lame& lame);

template <int D>
Polar<D, double> polar_of(const Deformation<D>& deformation);
/// Stress and energy as R and S make them.
template <int D>
Deformation<D> deformation_of(const Polar<D, double>& polar, const Lame& lame);

/// Force on corner k, N: -A P g_k.
template <int D>
Eigen::Matrix<double, D, 1> membrane_force(const Element& element, const Deformation<D>& deformation, int k) {
  const Eigen::Vector2d g(element.gradient[static_cast<std::size_t>(k)].x,
                          element.gradient[static_cast<std::size_t>(k)].y);
  return -element.material_area() * (deformation.rotation * (deformation.stress * g));
}

}  // namespace cutbench
