// The constant-strain membrane triangle: linear, co-rotational or nonlinear, in the plane or in space.
//
// A measure of strain makes of F = sum x_k (x) g_k (D x 2) a strain e (symmetric, 2 x 2) and a frame B (D x 2):
//   linear         e = sym F - I          B = I
//   corotational   e = S - I              B = R, with the polar decomposition F = R S
//   green          e = (F^T F - I) / 2    B = F
//   springs        as green: springs.h makes another stress and energy of it
// The energy per rest area is mu e:e + lambda/2 (tr e)^2, the stress s = 2 mu e + lambda (tr e) I, and the first Piola
// stress P = B s, exactly: the change of R does no work.
//
// green is the Saint Venant-Kirchhoff material (Sifakis and Barbic, FEM Simulation of 3D Deformable Solids, SIGGRAPH
// 2012 courses, part 1, chapter 3), the nonlinear reference. With the moduli of plane stress it is the solid sheet's at
// any strain: without stress across the sheet E33 = -lambda / (lambda + 2 mu) (E11 + E22) of the solid, as in linear
// theory. It is smooth at every F, collapsed ones too, so that no step needs a barrier. Its limits: a strip stretched
// to L times its length pulls with E L (L^2 - 1) / 2, and is sqrt(1 - nu (L^2 - 1)) as wide; it gives way below L =
// 1/sqrt(3). Rubber (neo-Hookean) is softer than linear elasticity under tension, this is stiffer: no one law is right
// at large strains.
//
// The second derivative of the energy is that of linear elasticity turned by B, and what the stress adds to it:
// - of corotational (Smith, de Goes and Kim, Analytic eigensystems for isotropic distortion energies, TOG 38, 2019):
// the
//   in-plane twist, with (s1 + s2) / (S1 + S2); and, in space, tilting out of the plane, with s_k / S_k along each
//   principal direction (Baraff and Witkin's geometric stiffness);
// - of green: g s h I, for corners with the gradients g and h (Bonet and Wood, Nonlinear Continuum Mechanics for Finite
//   Element Analysis, 2008, 9.4.3: the initial stress component).
// These are negative under compression. They are then left out, principal direction by principal direction, so that the
// matrix is positive semi-definite, or kept, or all left out: StressStiffness says which.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "harness/base/conversions.h"
#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/physics.h"

namespace cutbench {

/// Lame parameters per thickness, N/m.
struct Lame {
  double mu, lambda;
};
/// Plane stress: lambda = E nu / (1 - nu^2); plane strain: E nu / ((1 + nu)(1 - 2 nu)).
Lame lame_of(const Material& material, Plane plane);
/// Young's modulus of such a sheet, N/m: of plane strain, E / (1 - nu^2).
double young_of(const Lame& lame);

/// How a membrane answers to being deformed.
struct MembraneLaw {
  Strain strain;
  StressStiffness of_stress;
  Lame lame;
};
MembraneLaw law_of(const Material& material, const Physics& physics);

/// How one triangle is deformed.
template <int D>
struct Deformation {
  Eigen::Matrix<double, D, 2> frame;  ///< B; R has orthonormal columns, also where the triangle has collapsed
  Eigen::Matrix2d strain;             ///< e
  Eigen::Matrix2d stress;             ///< s, N/m
  double energy;                      ///< N/m: per rest area
};

/// B by its columns, and e, of one triangle or of several side by side (lanes.h).
template <int D, class Number>
struct StrainInFrame {
  std::array<std::array<Number, D>, 2> frame;
  Number xx, xy, yy;  ///< of e
};

/// With gradient F, of any shape, also a collapsed one. \pre not springs: they need the triangle's edges.
template <int D>
Deformation<D> deformation_of(const Eigen::Matrix<double, D, 2>& f, Strain strain, const Lame& lame);
/// For every shape, collapsed triangles included. \pre x has the vertices of `element`.
template <int D>
Deformation<D> deformation_of(const Element& element, const Field& x, Strain strain, const Lame& lame);

template <int D>
StrainInFrame<D, double> strain_of(const Deformation<D>& deformation);
/// Stress and energy as the strain makes them.
template <int D>
Deformation<D> deformation_of(const Element& element, const StrainInFrame<D, double>& strained, Strain strain,
                              const Lame& lame);

/// Force on corner k, N: -A P g_k, with P = B s.
template <int D>
Eigen::Matrix<double, D, 1> membrane_force(const Element& element, const Deformation<D>& deformation, int k) {
  const Eigen::Vector2d g(element.gradient[to_size(k)].x, element.gradient[to_size(k)].y);
  return -element.material_area() * (deformation.frame * (deformation.stress * g));
}

}  // namespace cutbench
