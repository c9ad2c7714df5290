#include "harness/fem/membrane.h"

#include <algorithm>
#include <cmath>

namespace cutbench {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Lame lame_of(const Material& material, Plane plane) {
  const double e = material.stiffness, nu = material.poisson;
  return {e / (2 * (1 + nu)), plane == Plane::stress ? e * nu / (1 - nu * nu) : e * nu / ((1 + nu) * (1 - 2 * nu))};
}

namespace {

Vector2d gradient(const Element& element, std::size_t k) { return {element.gradient[k].x, element.gradient[k].y}; }

/// The rotation nearest to f: never a reflection, the identity where none is nearest.
Matrix2d nearest_rotation(const Matrix2d& f) {
  const double c = f(0, 0) + f(1, 1), s = f(1, 0) - f(0, 1), r = std::hypot(c, s);
  if (!(r > 0)) return Matrix2d::Identity();
  return (Matrix2d() << c / r, -s / r, s / r, c / r).finished();
}

Vector3d any_orthogonal(const Vector3d& v) {
  Eigen::Index smallest = 0;
  v.cwiseAbs().minCoeff(&smallest);
  return v.cross(Vector3d::Unit(smallest)).normalized();
}

/// Orthonormal vectors that span the plane of f's columns; any plane through them where they span none.
Eigen::Matrix<double, 3, 2> tangent_frame(const Eigen::Matrix<double, 3, 2>& f) {
  const double a = f.col(0).norm(), b = f.col(1).norm();
  const Vector3d normal = f.col(0).cross(f.col(1));
  Eigen::Matrix<double, 3, 2> frame;
  if (normal.norm() > 1e-14 * a * b) {
    frame.col(0) = f.col(0) / a;
    frame.col(1) = normal.normalized().cross(frame.col(0));
  } else if (std::max(a, b) > 0) {
    frame.col(0) = a >= b ? f.col(0) / a : f.col(1) / b;
    frame.col(1) = any_orthogonal(frame.col(0));
  } else {
    frame = Eigen::Matrix<double, 3, 2>::Identity();
  }
  return frame;
}

template <int D>
void add_stress(const Lame& lame, Deformation<D>& d) {
  const Matrix2d e = d.stretch - Matrix2d::Identity();
  const double trace = e.trace();
  d.stress = 2 * lame.mu * e + lame.lambda * trace * Matrix2d::Identity();
  d.energy = lame.mu * e.squaredNorm() + lame.lambda / 2 * trace * trace;
}

}  // namespace

template <int D>
Deformation<D> deformation_of(const Element& element, const Field& x, Strain strain, const Lame& lame) {
  // Differences of positions, so that a sheet far from the origin loses nothing.
  const auto at = [&](std::size_t k) {
    return Eigen::Map<const Eigen::Matrix<double, D, 1>>(x.data() + D * element.vertex[k].value);
  };
  const Eigen::Matrix<double, D, 2> f =
      (at(1) - at(0)) * gradient(element, 1).transpose() + (at(2) - at(0)) * gradient(element, 2).transpose();
  return deformation_of<D>(f, strain, lame);
}

template <int D>
Deformation<D> deformation_of(const Eigen::Matrix<double, D, 2>& f, Strain strain, const Lame& lame) {
  Deformation<D> d;
  if (strain == Strain::linear) {
    d.rotation = Eigen::Matrix<double, D, 2>::Identity();
    const Matrix2d in_plane = f.template topRows<2>();
    d.stretch = (in_plane + in_plane.transpose()) / 2;
  } else if constexpr (D == 2) {
    d.rotation = nearest_rotation(f);
    d.stretch = d.rotation.transpose() * f;
  } else {
    const Eigen::Matrix<double, 3, 2> frame = tangent_frame(f);
    const Matrix2d in_plane = frame.transpose() * f, turn = nearest_rotation(in_plane);
    d.rotation = frame * turn;
    d.stretch = turn.transpose() * in_plane;
  }
  d.stretch(0, 1) = d.stretch(1, 0) = (d.stretch(0, 1) + d.stretch(1, 0)) / 2;
  add_stress(lame, d);
  return d;
}

template <int D>
Deformation<D> deformation_of(const Polar<D, double>& polar, const Lame& lame) {
  Deformation<D> d;
  for (std::size_t k = 0; k < 2; ++k)
    d.rotation.col(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::Matrix<double, D, 1>>(polar.rotation[k].data());
  d.stretch << polar.xx, polar.xy, polar.xy, polar.yy;
  add_stress(lame, d);
  return d;
}

template <int D>
Polar<D, double> polar_of(const Deformation<D>& d) {
  Polar<D, double> polar;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t r = 0; r < D; ++r)
      polar.rotation[k][r] = d.rotation(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k));
  polar.xx = d.stretch(0, 0), polar.xy = d.stretch(0, 1), polar.yy = d.stretch(1, 1);
  return polar;
}

template struct Deformation<2>;
template struct Deformation<3>;
template Deformation<2> deformation_of<2>(const Eigen::Matrix<double, 2, 2>&, Strain, const Lame&);
template Deformation<3> deformation_of<3>(const Eigen::Matrix<double, 3, 2>&, Strain, const Lame&);
template Deformation<2> deformation_of<2>(const Element&, const Field&, Strain, const Lame&);
template Deformation<3> deformation_of<3>(const Element&, const Field&, Strain, const Lame&);
template Deformation<2> deformation_of<2>(const Polar<2, double>&, const Lame&);
template Deformation<3> deformation_of<3>(const Polar<3, double>&, const Lame&);
template Polar<2, double> polar_of<2>(const Deformation<2>&);
template Polar<3, double> polar_of<3>(const Deformation<3>&);

}  // namespace cutbench
