// One membrane triangle: what must hold for any shape and any deformation, by finite differences and by hand.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/elements/element_stiffness.h"
#include "tests/dense_solves.h"

namespace cutbench {
namespace {

Element element_with(std::array<Point2, 3> c) {
  Element e;
  e.vertex = {DeformedIndex(0), DeformedIndex(1), DeformedIndex(2)};
  const double twice = cross(c[1] - c[0], c[2] - c[0]);
  e.area = twice / 2;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 edge = c[(k + 2) % 3] - c[(k + 1) % 3];
    e.gradient[k] = {-edge.y / twice, edge.x / twice};
  }
  return e;
}

std::array<Point2, 3> random_triangle(Random& random) {
  for (;;) {
    std::array<Point2, 3> c;
    for (auto& p : c) p = {random.between(-1, 1), random.between(-1, 1)};
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    if (area > 0.01) return c;
    if (area < -0.01) return {c[0], c[2], c[1]};
  }
}

template <int D>
Field place(const std::array<Point2, 3>& c) {
  Field x = Field::Zero(3 * D);
  for (int k = 0; k < 3; ++k) {
    x[D * k] = c[to_size(k)].x;
    x[D * k + 1] = c[to_size(k)].y;
  }
  return x;
}

template <int D>
Eigen::Matrix<double, D, D> random_rotation(Random& random) {
  const double angle = random.between(-3, 3);
  if constexpr (D == 2) {
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  } else {
    const Eigen::Vector3d axis(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }
}

template <int D>
Field forces(const Element& e, const Field& x, Strain strain, const Lame& lame) {
  const auto d = deformation_of<D>(e, x, strain, lame);
  Field f(3 * D);
  for (int k = 0; k < 3; ++k) f.segment<D>(D * k) = membrane_force<D>(e, d, k);
  return f;
}

template <int D>
Eigen::MatrixXd stiffness(const Element& e, const Field& x, Strain strain, const Lame& lame,
                          StressStiffness of_stress = StressStiffness::positive) {
  const ElementStiffness<D> stiffness(e, deformation_of<D>(e, x, strain, lame), {strain, of_stress, lame});
  Eigen::MatrixXd k(3 * D, 3 * D);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      k.block<D, D>(D * to_int(i), D * to_int(j)) =
          Eigen::Map<const Eigen::Matrix<double, D, D>>(stiffness.block(i, j).data());
  return k;
}

template <int D>
void expect_derivative_of_the_force(const Element& e, const Field& x, Strain strain, const Lame& lame,
                                    const Eigen::MatrixXd& k) {
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = 1e-6;
    Field right = x, left = x;
    right[j] += h;
    left[j] -= h;
    const Field column = -(forces<D>(e, right, strain, lame) - forces<D>(e, left, strain, lame)) / (2 * h);
    EXPECT_LT((column - k.col(j)).norm(), 1e-6 * k.norm());
  }
}

const Material skin{.stiffness = 1000, .poisson = 0.45};
const std::array large_turns{Strain::corotational, Strain::green, Strain::springs};  // rigid motions are free

template <class Dimension>
class Membrane : public testing::Test {
 public:
  static constexpr int dimension = Dimension::value;
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Membrane, Dimensions, );

TYPED_TEST(Membrane, RigidMotionGivesNoForce) {
  constexpr int D = TestFixture::dimension;
  Random random(1);
  const Lame lame = lame_of(skin, Plane::stress);
  for (int i = 0; i < 200; ++i) {
    const auto c = random_triangle(random);
    const Element e = element_with(c);
    Field x = place<D>(c);
    const auto turn = random_rotation<D>(random);
    for (int k = 0; k < 3; ++k) x.segment<D>(D * k) = turn * x.segment<D>(D * k);
    for (int k = 0; k < 3; ++k) x[D * k] += 3;
    for (const Strain strain : large_turns) {
      EXPECT_LT(forces<D>(e, x, strain, lame).cwiseAbs().maxCoeff(), 1e-12 * skin.stiffness);
      EXPECT_LT(deformation_of<D>(e, x, strain, lame).energy, 1e-24 * skin.stiffness);
    }
  }
}

TYPED_TEST(Membrane, ForceIsTheDerivativeOfTheEnergy) {
  constexpr int D = TestFixture::dimension;
  Random random(2);
  for (const Plane plane : {Plane::stress, Plane::strain})
    for (const auto& [strain, name] : strain_names) {
      const Lame lame = lame_of(skin, plane);
      for (int i = 0; i < 100; ++i) {
        const auto c = random_triangle(random);
        const Element e = element_with(c);
        Field x = place<D>(c);
        for (auto& value : x) value += random.between(-0.3, 0.3);
        const Field f = forces<D>(e, x, strain, lame);
        for (Eigen::Index k = 0; k < x.size(); ++k) {
          const double h = 1e-6;
          const auto energy = [&](double d) {
            Field y = x;
            y[k] += d;
            return e.area * deformation_of<D>(e, y, strain, lame).energy;
          };
          EXPECT_NEAR(-(energy(h) - energy(-h)) / (2 * h), f[k], 1e-6 * (f.norm() + skin.stiffness));
        }
      }
    }
}

TYPED_TEST(Membrane, StiffnessIsTheDerivativeOfTheForceUnderTension) {
  constexpr int D = TestFixture::dimension;
  Random random(3);
  const Lame lame = lame_of(skin, Plane::stress);
  int tensed = 0;
  for (int i = 0; i < 300; ++i) {
    const auto c = random_triangle(random);
    const Element e = element_with(c);
    Field x = 1.3 * place<D>(c);
    for (auto& value : x) value += random.between(-0.02, 0.02);
    const auto turn = random_rotation<D>(random);
    for (int k = 0; k < 3; ++k) x.segment<D>(D * k) = turn * x.segment<D>(D * k);
    for (const Strain strain : large_turns) {
      const Eigen::Matrix2d stress = deformation_of<D>(e, x, strain, lame).stress;
      if (!(stress.trace() > 0 && stress.determinant() > 0)) continue;
      ++tensed;
      const Eigen::MatrixXd k = stiffness<D>(e, x, strain, lame);
      EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
      expect_derivative_of_the_force<D>(e, x, strain, lame, k);
    }
  }
  EXPECT_GT(tensed, 200);
}

TYPED_TEST(Membrane, FullStiffnessIsTheDerivativeOfTheForceUnderCompressionToo) {
  constexpr int D = TestFixture::dimension;
  Random random(7);
  const Lame lame = lame_of(skin, Plane::stress);
  int indefinite = 0;
  for (int i = 0; i < 200; ++i) {
    const auto c = random_triangle(random);
    const Element e = element_with(c);
    Field x = random.between(0.7, 1.2) * place<D>(c);
    for (auto& value : x) value += random.between(-0.02, 0.02);
    for (const Strain strain : large_turns) {
      const Eigen::MatrixXd k = stiffness<D>(e, x, strain, lame, StressStiffness::full);
      indefinite += eigenvalues(k)[0] < -1e-6 * k.norm();
      expect_derivative_of_the_force<D>(e, x, strain, lame, k);
    }
  }
  EXPECT_GT(indefinite, 100);
}

TYPED_TEST(Membrane, StiffnessIsPositiveSemiDefiniteHoweverCompressed) {
  constexpr int D = TestFixture::dimension;
  Random random(4);
  const Lame lame = lame_of(skin, Plane::stress);
  for (int i = 0; i < 300; ++i) {
    const Element e = element_with(random_triangle(random));
    Field x(3 * D);
    for (auto& value : x) value = random.between(-1, 1);
    for (const Strain strain : large_turns) {
      const Eigen::VectorXd values = eigenvalues(stiffness<D>(e, x, strain, lame));
      EXPECT_GE(values[0], -1e-12 * values[values.size() - 1]);
    }
  }
}

/// A strain of 1e-5 is as good as none: the measures differ by its square.
TYPED_TEST(Membrane, AllMeasuresAgreeWhereLittleIsStrained) {
  constexpr int D = TestFixture::dimension;
  Random random(8);
  const Lame lame = lame_of(skin, Plane::stress);
  for (int i = 0; i < 100; ++i) {
    const auto c = random_triangle(random);
    const Element e = element_with(c);
    Field x = place<D>(c);
    for (auto& value : x) value += 1e-5 * random.between(-1, 1);
    const Field linear = forces<D>(e, x, Strain::linear, lame);
    const double strained = deformation_of<D>(e, x, Strain::linear, lame).strain.norm();
    for (const Strain strain : {Strain::corotational, Strain::green})
      EXPECT_LT((forces<D>(e, x, strain, lame) - linear).norm(),
                1e-3 * linear.norm() + 1e-3 * strained * skin.stiffness)
          << name_of(strain_names, strain);
  }
}

/// Of one triangle at x, by the lengths of its edges.
template <int D>
double energy_of_springs(const std::array<Point2, 3>& c, const Field& x, double young) {
  const double area = cross(c[1] - c[0], c[2] - c[0]) / 2;
  double energy = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double rest = std::sqrt(squared_length(c[to_size(next)] - c[to_size(k)]));
    const double length = (x.segment<D>(D * next) - x.segment<D>(D * k)).norm(),
                 constant = young * area / (rest * rest);
    energy += constant / 2 * (length - rest) * (length - rest);
  }
  return energy;
}

TYPED_TEST(Membrane, SpringsHaveTheEnergyOfTheirEdges) {
  constexpr int D = TestFixture::dimension;
  Random random(9);
  const Lame lame = lame_of(skin, Plane::stress);
  for (int i = 0; i < 100; ++i) {
    const auto c = random_triangle(random);
    const Element e = element_with(c);
    Field x(3 * D);
    for (auto& value : x) value = random.between(-1, 1);
    const double expected = energy_of_springs<D>(c, x, skin.stiffness);
    EXPECT_NEAR(e.area * deformation_of<D>(e, x, Strain::springs, lame).energy, expected, 1e-12 * expected);
  }
}

/// On equilateral triangles springs are linear elasticity with Poisson's ratio 1/3, whichever way they lie; on no other
/// triangle, and with no other ratio.
TYPED_TEST(Membrane, SpringsAreElasticityOnEquilateralTrianglesWithOneThirdOnly) {
  constexpr int D = TestFixture::dimension;
  Random random(10);
  const auto disagreement = [&](double poisson, bool equilateral) {
    const Lame lame = lame_of({.stiffness = 1000, .poisson = poisson}, Plane::stress);
    const double angle = random.between(0, 6);
    std::array<Point2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = angle + (equilateral ? 2.0943951023931953 : 1.8) * to_double(k);
      c[k] = {0.4 * std::cos(at), 0.4 * std::sin(at)};
    }
    const Element e = element_with(c);
    const Field x = place<D>(c);
    const Eigen::MatrixXd exact = stiffness<D>(e, x, Strain::linear, lame, StressStiffness::none);
    return (stiffness<D>(e, x, Strain::springs, lame) - exact).norm() / exact.norm();
  };
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT(disagreement(1.0 / 3, true), 1e-12);
    EXPECT_GT(disagreement(1.0 / 3, false), 0.01);
    EXPECT_GT(disagreement(0.25, true), 0.01);
    EXPECT_GT(disagreement(0.45, true), 0.01);
  }
}

/// What a solid strip of unit width pulls with, stretched to L times its length while its width is free, by hand: of
/// linear elasticity E (L - 1); of the Saint Venant-Kirchhoff material E L (L^2 - 1) / 2 whatever Poisson's ratio, for
/// only the stress along the strip is not zero.
TYPED_TEST(Membrane, AStretchedStripPullsAsTheSolidDoes) {
  constexpr int D = TestFixture::dimension;
  const Lame lame = lame_of(skin, Plane::stress);
  for (const double length : {0.7, 0.9, 1.1, 1.25, 1.4}) {
    Eigen::Matrix<double, D, 2> f = Eigen::Matrix<double, D, 2>::Zero();
    const double green = (length * length - 1) / 2, nu = skin.poisson;
    f(0, 0) = length;
    f(1, 1) = std::sqrt(1 - 2 * nu * green);
    const auto nonlinear = deformation_of<D>(f, Strain::green, lame);
    const Eigen::Matrix<double, D, 2> stress = nonlinear.frame * nonlinear.stress;
    EXPECT_NEAR(stress(0, 0), skin.stiffness * length * green, 1e-9 * skin.stiffness);
    EXPECT_NEAR(stress(1, 1), 0, 1e-9 * skin.stiffness);
    f(1, 1) = 1 - nu * (length - 1);
    const auto turned = deformation_of<D>(f, Strain::corotational, lame);
    EXPECT_NEAR(turned.stress(0, 0), skin.stiffness * (length - 1), 1e-9 * skin.stiffness);
    EXPECT_NEAR(turned.stress(1, 1), 0, 1e-9 * skin.stiffness);
  }
}

/// Collapsed and inverted triangles.
TYPED_TEST(Membrane, P6CollapsedTrianglesHaveAProperRotation) {
  constexpr int D = TestFixture::dimension;
  const std::array<Point2, 3> c{{{0, 0}, {1, 0}, {0, 1}}};
  const Element e = element_with(c);
  const Lame lame = lame_of(skin, Plane::stress);
  std::vector<Field> collapsed;
  collapsed.push_back(Field::Zero(3 * D));  // to a point
  Field x = place<D>(c);
  x.segment<D>(2 * D) = x.segment<D>(0);  // onto an edge
  collapsed.push_back(x);
  x = place<D>(c);
  x.segment<D>(2 * D) = (x.segment<D>(0) + x.segment<D>(D)) / 2;  // a vertex on the opposite edge
  collapsed.push_back(x);
  if (D == 2) {  // inverted; in space it would be turned over
    x = place<D>(c);
    x[2 * D + 1] = -1;
    collapsed.push_back(x);
  }
  x = place<D>(c);
  x[2 * D + 1] = 1e-300;
  collapsed.push_back(x);
  for (const Field& place : collapsed) {
    const auto d = deformation_of<D>(e, place, Strain::corotational, lame);
    EXPECT_LT((d.frame.transpose() * d.frame - Eigen::Matrix2d::Identity()).norm(), 1e-12);
    if constexpr (D == 2) {
      EXPECT_NEAR(d.frame.determinant(), 1, 1e-12);
    }
    EXPECT_TRUE(std::isfinite(d.energy));
    EXPECT_TRUE(forces<D>(e, place, Strain::corotational, lame).allFinite());
    EXPECT_TRUE(stiffness<D>(e, place, Strain::corotational, lame).allFinite());
    EXPECT_GT(forces<D>(e, place, Strain::corotational, lame).norm(), 0) << "nothing pulls it back";
  }
}

/// MacNeal and Harder 1985: sigma = 1333.33, tau = 400 for E = 1e6, nu = 1/4 and the strain below.
TEST(Membrane2, StressOfTheStandardPatch) {
  const Lame lame = lame_of({.stiffness = 1e6, .poisson = 0.25}, Plane::stress);
  const std::array<Point2, 3> c{{{0.1, 0.2}, {0.9, 0.3}, {0.4, 0.8}}};
  Field x = place<2>(c);
  for (int k = 0; k < 3; ++k) {
    const auto p = c[to_size(k)];
    x[2 * k] += 1e-3 * (p.x + p.y / 2);
    x[2 * k + 1] += 1e-3 * (p.y + p.x / 2);
  }
  const auto d = deformation_of<2>(element_with(c), x, Strain::linear, lame);
  EXPECT_NEAR(d.stress(0, 0), 4000.0 / 3, 1e-8);
  EXPECT_NEAR(d.stress(1, 1), 4000.0 / 3, 1e-8);
  EXPECT_NEAR(d.stress(0, 1), 400, 1e-8);
}

}  // namespace
}  // namespace cutbench
