// Membrane elements computed four at a time, against plain formulas for one element.

#include "harness/fem/elements/membrane_sheet.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45};

/// The second derivative of the energy per area along two changes of F, mode by mode (membrane.h): in the frame B,
/// linear elasticity; of corotational the twist and, out of the plane, tension over stretch along the principal
/// directions; of green, tension along the principal directions. Of springs: along each edge, and tension over length
/// in all directions.
template <int D>
double second_derivative(const Element& element, const Deformation<D>& d, Strain strain, StressStiffness of_stress,
                         const Lame& lame, const Eigen::Matrix<double, D, 2>& one,
                         const Eigen::Matrix<double, D, 2>& other) {
  if (strain == Strain::springs) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d along = Eigen::Vector2d(-element.gradient[k].y, element.gradient[k].x).normalized();
      const Eigen::Matrix<double, D, 1> edge = d.frame * along, pointing = edge.normalized();
      if (edge.norm() <= 1e-14 * d.frame.norm()) continue;  // it points nowhere
      const double tension = 1 - 1 / edge.norm();
      const double taken = of_stress == StressStiffness::full       ? tension
                           : of_stress == StressStiffness::positive ? std::max(tension, 0.0)
                                                                    : 0;
      const Eigen::Matrix<double, D, 1> u = one * along, v = other * along;
      sum += skin.stiffness * ((1 - taken) * pointing.dot(u) * pointing.dot(v) + taken * u.dot(v));
    }
    return sum;
  }
  const Eigen::Matrix2d a = d.frame.transpose() * one, b = d.frame.transpose() * other;
  const Eigen::Matrix2d e = (a + a.transpose()) / 2, f = (b + b.transpose()) / 2;
  double sum = 2 * lame.mu * e.cwiseProduct(f).sum() + lame.lambda * e.trace() * f.trace();
  if (strain == Strain::linear || of_stress == StressStiffness::none) return sum;
  const bool full = of_stress == StressStiffness::full;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(d.strain);
  if (strain == Strain::green) {
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d axis = principal.eigenvectors().col(k);
      const double tension = axis.dot(d.stress * axis);
      if (full || tension > 0) sum += tension * (one * axis).dot(other * axis);
    }
    return sum;
  }
  const double stretches = d.strain.trace() + 2, twist = stretches > 0 ? d.stress.trace() / stretches / 2 : 0;
  if (full || twist > 0) sum += twist * (a(1, 0) - a(0, 1)) * (b(1, 0) - b(0, 1));
  if constexpr (D == 3) {
    const Eigen::Vector3d normal = d.frame.col(0).cross(d.frame.col(1));
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d axis = principal.eigenvectors().col(k);
      const double stretch = 1 + principal.eigenvalues()[k], tension = axis.dot(d.stress * axis);
      if (stretch > 0 && (full || tension > 0))
        sum += tension / stretch * normal.dot(one * axis) * normal.dot(other * axis);
    }
  }
  return sum;
}

template <int D>
struct Reference {
  Field force;
  Eigen::MatrixXd stiffness;
  double energy = 0;

  Reference(const ElementTable& elements, const Field& x, const Physics& physics)
      : force(Field::Zero(x.size())), stiffness(Eigen::MatrixXd::Zero(x.size(), x.size())) {
    const Lame lame = lame_of(skin, physics.plane);
    for (const Element& e : elements) {
      if (!e.alive()) continue;
      const auto d = deformation_of<D>(e, x, physics.strain, lame);
      energy += e.area * d.energy;
      const auto change = [&](int i) {  // of F, where unknown i of the element grows by one
        const Point2 g = e.gradient[to_size(i / D)];
        Eigen::Matrix<double, D, 2> f = Eigen::Matrix<double, D, 2>::Zero();
        f.row(i % D) << g.x, g.y;
        return f;
      };
      const auto unknown = [&](int i) { return D * e.vertex[to_size(i / D)].value + i % D; };
      for (int i = 0; i < 3 * D; ++i) {
        force[unknown(i)] += membrane_force<D>(e, d, i / D)[i % D];
        for (int j = 0; j < 3 * D; ++j)
          stiffness(unknown(i), unknown(j)) +=
              e.area * second_derivative<D>(e, d, physics.strain, physics.stress_stiffness, lame, change(i), change(j));
      }
    }
  }
};

/// Stretched here, compressed there, at random; some triangles collapsed to an edge or a point, where that is asked.
template <int D>
Field random_places(const Body<D>& body, Random& random, bool collapsed) {
  Field x = bent(body.model, body.sheet);
  for (auto& value : x) value += random.between(-0.03, 0.03);
  for (std::size_t i = 4; collapsed && i < body.model.elements().size(); i += 9) {
    const Element& e = body.model.elements()[i];
    for (std::size_t k = 1; e.alive() && k < 2 + i % 2; ++k)
      x.segment<D>(D * e.vertex[k].value) = x.segment<D>(D * e.vertex[0].value).eval();
  }
  return x;
}

template <int D>
void compare(Strain strain, StressStiffness of_stress = StressStiffness::none) {
  Random random(7);
  for (const std::string family : sheet_families()) {
    SCOPED_TRACE(family);
    const Physics physics{.dimension = D, .strain = strain, .stress_stiffness = of_stress};
    Body<D> body(make_sheet(family, 5), skin, physics);
    body.cut(line({0.2, 0.43}, {0.8, 0.57}), "element_deletion");
    Model<D>& model = body.model;
    ASSERT_TRUE(std::any_of(model.elements().begin(), model.elements().end(), [](auto& e) { return !e.alive(); }));
    const Field x = random_places<D>(body, random, of_stress != StressStiffness::full);
    const Reference<D> plain(model.elements(), x, physics);
    model.rotate(x);
    model.assemble(0, 2);
    Field force = Field::Zero(x.size());
    model.add_internal_force(x, force);
    EXPECT_LE((force - plain.force).cwiseAbs().maxCoeff(), 1e-12 * plain.force.cwiseAbs().maxCoeff());
    EXPECT_NEAR(model.energy(x, Field::Zero(x.size())).membrane, plain.energy, 1e-12 * plain.energy);
    const Eigen::MatrixXd a = dense(model);
    EXPECT_LE((a - 2 * plain.stiffness).cwiseAbs().maxCoeff(), 1e-12 * a.cwiseAbs().maxCoeff());
    EXPECT_EQ((a - a.transpose()).cwiseAbs().maxCoeff(), 0) << "its halves are the same numbers";
  }
}

template <int D>
void compare_all() {
  compare<D>(Strain::linear);
  for (const auto& [of_stress, name] : stress_stiffness_names) {
    SCOPED_TRACE(name);
    for (const Strain strain : {Strain::corotational, Strain::green, Strain::springs}) compare<D>(strain, of_stress);
  }
}

TEST(MembraneSheet, IsWhatPlainFormulasSay2) { compare_all<2>(); }
TEST(MembraneSheet, IsWhatPlainFormulasSay3) { compare_all<3>(); }

TEST(MembraneSheet, KeepsADeformationForEachElement) {
  Body<3> body(make_sheet("delaunay", 5), skin, {});
  const Field x = bent(body.model, body.sheet);
  body.model.rotate(x);
  const Lame lame = lame_of(skin, Plane::stress);
  for (std::size_t e = 0; e < body.model.elements().size(); ++e) {
    const auto kept = body.model.deformation(e),
               plain = deformation_of<3>(body.model.elements()[e], x, Strain::corotational, lame);
    EXPECT_LE((kept.frame - plain.frame).norm(), 1e-12);
    EXPECT_LE((kept.strain - plain.strain).norm(), 1e-12);
    EXPECT_LE((kept.stress - plain.stress).norm(), 1e-12 * skin.stiffness);
    EXPECT_NEAR(kept.energy, plain.energy, 1e-12 * skin.stiffness);
  }
}

}  // namespace
}  // namespace cutbench
