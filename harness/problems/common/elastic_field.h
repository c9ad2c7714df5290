// A plane-stress field known in closed form, by its two complex potentials (Kolosov and Muskhelishvili: Muskhelishvili,
// Some Basic Problems of the Mathematical Theory of Elasticity, 1953, chapters 5, 18 and 124):
//   2 mu (u + i v) = kappa phi(z) - z conj(phi'(z)) - conj(psi(z)),
//   s_xx + s_yy = 4 Re phi',  s_yy - s_xx + 2 i s_xy = 2 (conj(z) phi'' + psi').
// Two analytic functions that are single-valued off the cut are in equilibrium by themselves; that the lips are free of
// traction is what each solution is made for (exact_fields.h).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>

#include "harness/fem/elements/physics.h"
#include "harness/mesh/types.h"

namespace cutbench {

using Complex = std::complex<double>;

/// Stiffness per thickness, as in Material.
struct Elastic {
  double young;    ///< Young's modulus x thickness, N/m
  double poisson;  ///< plane stress
  double mu() const { return young / (2 * (1 + poisson)); }
  double kappa() const { return (3 - poisson) / (1 + poisson); }
  Eigen::Matrix2d stress(const Eigen::Matrix2d& strain) const;
  Eigen::Matrix2d strain(const Eigen::Matrix2d& stress) const;
};

/// Where a solution's own axes lie in rest space.
struct Axes {
  Point2 origin;
  double angle = 0;  ///< of its x axis, radians
  Complex to_local(Point2 p) const;
  Point2 to_rest(Complex z) const;
};

/// At z in the solution's own frame; first derivatives are `_1`.
struct Potentials {
  Complex phi, phi_1, phi_2, psi, psi_1;
};

class ElasticField {
 public:
  /// Near the cut the sign of a coordinate of z decides the side.
  using Solution = std::function<Potentials(Complex z)>;
  /// z moved to the other side of the cut if it lies on it (to within rounding) and `side` does not agree with it.
  using OnSide = std::function<Complex(Complex z, Complex side)>;
  ElasticField(const Elastic& elastic, const Axes& frame, Solution potentials, OnSide on_side = {});

  struct State {
    Eigen::Vector2d displacement;  ///< m
    Eigen::Matrix2d gradient;      ///< d u_i / d x_j
    Eigen::Matrix2d stress;        ///< N/m
  };
  /// On the cut itself there are two: `side` is any point of the side meant, near p.
  State state(Point2 p, Point2 side) const;
  State state(Point2 p) const { return state(p, p); }
  Eigen::Vector2d displacement(Point2 p, Point2 side) const { return state(p, side).displacement; }
  Eigen::Vector2d displacement(Point2 p) const { return state(p).displacement; }
  Eigen::Matrix2d gradient(Point2 p) const { return state(p).gradient; }
  Eigen::Matrix2d stress(Point2 p) const { return state(p).stress; }

  const Elastic& elastic() const { return elastic_; }
  const Axes& frame() const { return frame_; }

 private:
  Complex to_local(Point2 p) const;

  Elastic elastic_;
  Axes frame_;
  Complex axis_;  // of the frame
  Eigen::Matrix2d rotation_;
  Solution potentials_;
  OnSide on_side_;
};

}  // namespace cutbench
