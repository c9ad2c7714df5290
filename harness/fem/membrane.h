// The constant-strain membrane triangle, linear or co-rotational, in the plane or in space.
//
// With F = sum x_k (x) g_k (D x 2), F = R S its polar decomposition (S symmetric 2 x 2) and e = S - I, the energy per
// rest area is mu e:e + lambda/2 (tr e)^2, isotropic in the singular values of F. Its first Piola stress is P = R s
// with s = 2 mu e + lambda (tr e) I, exactly: the change of R does no work. Its second derivative splits into modes
// (Smith, de Goes and Kim, Analytic eigensystems for isotropic distortion energies, TOG 38, 2019): stretch and shear,
// where it is that of linear elasticity turned by R; the in-plane twist, with (s1 + s2) / (S1 + S2); and, in space,
// tilting out of the plane, with s_k / S_k along each principal direction (Baraff and Witkin's geometric stiffness).
// The last three can be negative under compression and are then left out, so the matrix is positive semi-definite.
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

/// \pre x has the vertices of `element`.
template <int D>
Deformation<D> deformation_of(const Element& element, const Field& x, Strain strain, const Lame& lame);

/// Force on corner k, N: -A P g_k.
template <int D>
Eigen::Matrix<double, D, 1> membrane_force(const Element& element, const Deformation<D>& deformation, int k) {
  const Eigen::Vector2d g(element.gradient[static_cast<std::size_t>(k)].x,
                          element.gradient[static_cast<std::size_t>(k)].y);
  return -element.material_area() * (deformation.rotation * (deformation.stress * g));
}

/// The element's stiffness times a factor, N/m: 3 x 3 blocks of D x D, symmetric, positive semi-definite. Each block is
/// known in the element's own frame (the columns of R, and the normal) and turned from there.
template <int D>
class ElementStiffness {
 public:
  /// D values, and for D = 3 a zero, so that one operation does for four.
  using Column = Eigen::Matrix<double, D == 3 ? 4 : D, 1>;

  ElementStiffness(const Element& element, const Deformation<D>& deformation, Strain strain, const Lame& lame,
                   double factor);
  /// The columns of block (i, j).
  std::array<Column, D> block(std::size_t i, std::size_t j) const {
    const auto [a, b] = gradient_[i];
    const auto [c, d] = gradient_[j];
    const double both = mu_ * (a * c + b * d);
    const double xx = (lambda_ + mu_) * a * c + twist_ * b * d + both, xy = lambda_ * a * d + (mu_ - twist_) * b * c;
    const double yx = lambda_ * b * c + (mu_ - twist_) * a * d, yy = (lambda_ + mu_) * b * d + twist_ * a * c + both;
    const Column x = xx * frame_[0] + yx * frame_[1], y = xy * frame_[0] + yy * frame_[1];
    std::array<Column, D> columns;
    for (std::size_t k = 0; k < D; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      columns[k] = frame_[0][row] * x + frame_[1][row] * y;
      if constexpr (D == 3) columns[k] += (pulled_[i].x * c + pulled_[i].y * d) * frame_[2][row] * frame_[2];
    }
    return columns;
  }

 private:
  std::array<Column, D> frame_;              // the columns of R, the normal
  std::array<Point2, 3> gradient_, pulled_;  // g; factor area Q g
  double lambda_, mu_, twist_;               // times factor area
};

}  // namespace cutbench
