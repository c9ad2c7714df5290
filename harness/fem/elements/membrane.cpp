#include "harness/fem/elements/membrane.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/base/portable_hypot.h"

namespace cutbench {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Lame lame_of(const Material& material, Plane plane) {
  const double e = material.stiffness, nu = material.poisson;
  return {e / (2 * (1 + nu)), plane == Plane::stress ? e * nu / (1 - nu * nu) : e * nu / ((1 + nu) * (1 - 2 * nu))};
}

double young_of(const Lame& lame) { return 4 * lame.mu * (lame.mu + lame.lambda) / (2 * lame.mu + lame.lambda); }

MembraneLaw law_of(const Material& material, const Physics& physics) {
  return {physics.strain, physics.stress_stiffness_made(), lame_of(material, physics.plane)};
}

namespace {

Vector2d gradient(const Element& element, std::size_t k) { return {element.gradient[k].x, element.gradient[k].y}; }

/// The rotation nearest to f: never a reflection, the identity where none is nearest.
Matrix2d nearest_rotation(const Matrix2d& f) {
  const double c = f(0, 0) + f(1, 1), s = f(1, 0) - f(0, 1), r = portable_hypot(c, s);
  if (!(r > 0)) return Matrix2d::Identity();
  return (Matrix2d() << c / r, -s / r, s / r, c / r).finished();
}

Vector3d any_orthogonal(const Vector3d& v) {
  Eigen::Index smallest = 0;
  v.cwiseAbs().minCoeff(&smallest);
  return v.cross(Vector3d::Unit(smallest)).normalized();
}

/// Eigen's norm() may become an instruction that valgrind 3.19 doesn't know (docs/how-to/track_speed.md).
double length(const Vector3d& v) { return std::sqrt(v.squaredNorm()); }

/// Orthonormal vectors that span the plane of f's columns; any plane through them where they span none.
Eigen::Matrix<double, 3, 2> tangent_frame(const Eigen::Matrix<double, 3, 2>& f) {
  const double a = length(f.col(0)), b = length(f.col(1));
  const Vector3d normal = f.col(0).cross(f.col(1));
  Eigen::Matrix<double, 3, 2> frame;
  if (length(normal) > 1e-14 * a * b) {
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
Matrix2d tangent_frame(const Matrix2d&) { return Matrix2d::Identity(); }

/// Of springs along the edges (springs.h).
template <int D>
void add_spring_stress(const Element& element, double young, Deformation<D>& d) {
  d.stress.setZero();
  d.energy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2d across = gradient(element, k).normalized(), along(-across.y(), across.x());
    const double stretch = (d.frame * along).norm();
    d.energy += young / 2 * (stretch - 1) * (stretch - 1);
    if (stretch > 1e-14 * d.frame.norm()) d.stress += young * (1 - 1 / stretch) * along * along.transpose();
  }
}

template <int D>
void add_stress(const Lame& lame, Deformation<D>& d) {
  const double trace = d.strain.trace();
  d.stress = 2 * lame.mu * d.strain + lame.lambda * trace * Matrix2d::Identity();
  d.energy = lame.mu * d.strain.squaredNorm() + lame.lambda / 2 * trace * trace;
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
  Deformation<D> d = deformation_of<D>(f, strain, lame);
  if (strain == Strain::springs) add_spring_stress(element, young_of(lame), d);
  return d;
}

template <int D>
Deformation<D> deformation_of(const Eigen::Matrix<double, D, 2>& f, Strain strain, const Lame& lame) {
  Deformation<D> d;
  Matrix2d stretch = Matrix2d::Identity();
  switch (strain) {
    case Strain::linear: {
      d.frame = Eigen::Matrix<double, D, 2>::Identity();
      stretch = f.template topRows<2>();
      break;
    }
    case Strain::corotational: {
      const Eigen::Matrix<double, D, 2> frame = tangent_frame(f);
      const Matrix2d in_plane = frame.transpose() * f, turn = nearest_rotation(in_plane);
      d.frame = frame * turn;
      stretch = turn.transpose() * in_plane;
      break;
    }
    case Strain::green:
    case Strain::springs:
      d.frame = f;
      stretch = (f.transpose() * f + Matrix2d::Identity()) / 2;
      break;
  }
  d.strain = (stretch + stretch.transpose()) / 2 - Matrix2d::Identity();
  add_stress(lame, d);
  return d;
}

template <int D>
Deformation<D> deformation_of(const Element& element, const StrainInFrame<D, double>& strained, Strain strain,
                              const Lame& lame) {
  Deformation<D> d;
  for (std::size_t k = 0; k < 2; ++k)
    d.frame.col(to_index(k)) = Eigen::Map<const Eigen::Matrix<double, D, 1>>(strained.frame[k].data());
  d.strain << strained.xx, strained.xy, strained.xy, strained.yy;
  if (strain == Strain::springs)
    add_spring_stress(element, young_of(lame), d);
  else
    add_stress(lame, d);
  return d;
}

template <int D>
StrainInFrame<D, double> strain_of(const Deformation<D>& d) {
  StrainInFrame<D, double> strained;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t r = 0; r < D; ++r) strained.frame[k][r] = d.frame(to_index(r), to_index(k));
  strained.xx = d.strain(0, 0);
  strained.xy = d.strain(0, 1);
  strained.yy = d.strain(1, 1);
  return strained;
}

template struct Deformation<2>;
template struct Deformation<3>;
template Deformation<2> deformation_of<2>(const Eigen::Matrix<double, 2, 2>&, Strain, const Lame&);
template Deformation<3> deformation_of<3>(const Eigen::Matrix<double, 3, 2>&, Strain, const Lame&);
template Deformation<2> deformation_of<2>(const Element&, const Field&, Strain, const Lame&);
template Deformation<3> deformation_of<3>(const Element&, const Field&, Strain, const Lame&);
template Deformation<2> deformation_of<2>(const Element&, const StrainInFrame<2, double>&, Strain, const Lame&);
template Deformation<3> deformation_of<3>(const Element&, const StrainInFrame<3, double>&, Strain, const Lame&);
template StrainInFrame<2, double> strain_of<2>(const Deformation<2>&);
template StrainInFrame<3, double> strain_of<3>(const Deformation<3>&);

}  // namespace cutbench
