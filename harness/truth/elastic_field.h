// Exact plane-stress fields, each from its two complex potentials (Kolosov and Muskhelishvili: Muskhelishvili, Some
// Basic Problems of the Mathematical Theory of Elasticity, 1953, chapters 5, 18 and 124):
//   2 mu (u + i v) = kappa phi(z) - z conj(phi'(z)) - conj(psi(z)),
//   s_xx + s_yy = 4 Re phi',  s_yy - s_xx + 2 i s_xy = 2 (conj(z) phi'' + psi').
// Two analytic functions that are single-valued off the cut are in equilibrium by themselves; that the lips are free of
// traction is what each solution is made for.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

#include "harness/fem/physics.h"
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

/// A place and two directions: the end of a cut, and where it was going.
struct Tip {
  Point2 at;
  double angle;  ///< of the tangent of the cut, pointing out of it into the whole sheet
};

class ElasticField {
 public:
  ElasticField(const Elastic& elastic, const Axes& frame);
  virtual ~ElasticField() = default;

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

 protected:
  /// First derivatives are `_1`.
  struct Potentials {
    Complex phi, phi_1, phi_2, psi, psi_1;
  };
  /// At z in the solution's own frame. Near the cut the sign of a coordinate of z decides the side.
  virtual Potentials potentials(Complex z) const = 0;
  /// z moved to the other side of the cut if it lies on it (to within rounding) and `side` does not agree with it.
  virtual Complex on_side(Complex z, Complex) const { return z; }

 private:
  Complex to_local(Point2 p) const;

  Elastic elastic_;
  Axes frame_;
  Complex axis_;  // of the frame
  Eigen::Matrix2d rotation_;
};

/// The same stress everywhere; in the frame's axes.
class UniformField final : public ElasticField {
 public:
  UniformField(const Elastic& elastic, const Axes& frame, double xx, double yy, double xy)
      : ElasticField(elastic, frame), xx_(xx), yy_(yy), xy_(xy) {}

 protected:
  Potentials potentials(Complex z) const override;

 private:
  double xx_, yy_, xy_;
};

/// The first term at the tip of a long cut along the negative x axis (Williams 1957): stresses K / sqrt(2 pi x) ahead
/// of it. phi = (K1 - i K2) sqrt(z / 2 pi).
class WilliamsField final : public ElasticField {
 public:
  WilliamsField(const Elastic& elastic, const Axes& frame, double k1, double k2)
      : ElasticField(elastic, frame), k1_(k1), k2_(k2) {}

 protected:
  Potentials potentials(Complex z) const override;
  Complex on_side(Complex z, Complex side) const override;

 private:
  double k1_, k2_;
};

/// A straight cut from -a to a along the x axis of an infinite plate under the stress xx, yy, xy far away: the uniform
/// field, and phi = (yy - i xy) / 2 (sqrt(z^2 - a^2) - z). K1 = yy sqrt(pi a), K2 = xy sqrt(pi a) at both ends.
class StraightCrackField final : public ElasticField {
 public:
  StraightCrackField(const Elastic& elastic, const Axes& frame, double half_length, double xx, double yy, double xy)
      : ElasticField(elastic, frame), a_(half_length), xx_(xx), yy_(yy), xy_(xy) {}

 protected:
  Potentials potentials(Complex z) const override;
  Complex on_side(Complex z, Complex side) const override;

 private:
  double a_, xx_, yy_, xy_;
};

/// A cut along the arc R exp(i t), |t| <= A < pi, in an infinite plate under the stress s in all directions. With z in
/// units of R and X = sqrt(z^2 - 2 z cos A + 1), phi = (C X + (s - C) z) / 2, C = s / (1 + sin^2(A/2)), and
/// psi = conj(omega(1 / conj z)) - phi' / z, omega = (C X - (s - C) z) / 2.
class ArcCrackField final : public ElasticField {
 public:
  ArcCrackField(const Elastic& elastic, const Axes& frame, double radius, double half_angle, double stress);

 protected:
  Potentials potentials(Complex z) const override;
  Complex on_side(Complex z, Complex side) const override;

 private:
  Complex root(Complex z) const;  ///< X, in units of R

  double radius_, half_angle_, c_, d_;
  Complex end_, turn_;  // exp(i A), exp(i A / 2)
};

/// A round hole in an infinite plate pulled by s along the x axis (Kirsch 1898).
class HoleField final : public ElasticField {
 public:
  HoleField(const Elastic& elastic, const Axes& frame, double radius, double stress)
      : ElasticField(elastic, frame), radius_(radius), stress_(stress) {}

 protected:
  Potentials potentials(Complex z) const override;

 private:
  double radius_, stress_;
};

}  // namespace cutbench
