// The largest eigenvalue of (K, M), against a dense solve of matrices put together here from strain-displacement
// matrices.

#include "harness/fem/model/largest_eigenvalue.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

double by_dense_solve(const MeshData& mesh) {
  const auto n = to_index(2 * mesh.rest.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), mass = stiffness;
  Eigen::Matrix3d law;  // plane stress, E h = 1, nu = 0.3
  law << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  law /= 1 - 0.3 * 0.3;
  for (const auto& t : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const Point2 p = mesh.rest[to_size(t[to_size(k)])];
      corners.row(k) << 1, p.x, p.y;
    }
    const double area = corners.determinant() / 2;
    const Eigen::Matrix3d shape = corners.inverse();  // column k: coefficients of 1, x, y
    Eigen::Matrix<double, 3, 6> strain;
    for (int k = 0; k < 3; ++k) {
      strain.col(2 * k) << shape(1, k), 0, shape(2, k);
      strain.col(2 * k + 1) << 0, shape(2, k), shape(1, k);
    }
    const Eigen::Matrix<double, 6, 6> element = area * strain.transpose() * law * strain;
    const auto unknown = [&](int i) { return 2 * t[to_size(i / 2)] + i % 2; };
    for (int i = 0; i < 6; ++i) {
      mass(unknown(i), unknown(i)) += area / 3;
      for (int j = 0; j < 6; ++j) stiffness(unknown(i), unknown(j)) += element(i, j);
    }
  }
  return largest_mode(stiffness, mass);
}

TEST(LargestEigenvalue, IsThatOfADenseSolve) {
  for (const std::string family : sheet_families())
    for (const std::string method : {"conventional_split", "snap_or_split"})
      for (const std::string cut : {"curved", "several"}) {
        SCOPED_TRACE(family + ", " + method + ", " + cut);
        Table table(make_sheet(family, 7), find_method(method), find_method(method).parameter.value);
        for (const Curve& curve : make_case(cut, 5, 1, table.sheet)) ASSERT_EQ(table.cut(curve, 0.05), "");
        const double expected = by_dense_solve(table.sheet.to_mesh_data());
        EXPECT_NEAR(largest_eigenvalue(table.sheet), expected, 1e-4 * expected);
      }
}

TEST(LargestEigenvalue, OfAnUncutSheetIsThatOfADenseSolve) {
  for (const std::string family : sheet_families()) {
    SCOPED_TRACE(family);
    const MeshData mesh = make_sheet(family, 8);
    const double expected = by_dense_solve(mesh);
    EXPECT_NEAR(largest_eigenvalue(Sheet(mesh)), expected, 1e-3 * expected);
  }
}

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

Elasticity elasticity_of(const Material& material, BendingKind kind) {
  return {.poisson = material.poisson, .bending = kind, .bending_length2 = material.bending / material.stiffness};
}

TEST(LargestEigenvalue, WithBendingIsThatOfADenseSolveInSpace) {
  for (const BendingKind kind : {BendingKind::patches, BendingKind::hinges})
    for (const std::string method : {"conventional_split", "warp_and_refine"}) {
      Body<3> body(make_sheet("grid", 6), skin, {.bending = kind});
      ASSERT_EQ(body.cut(line({0.21, 0.27}, {0.83, 0.71}), method, find_method(method).parameter.value), Status::ok);
      const auto n = to_index(3 * body.sheet.deformed_slots());
      body.model.rotate(body.model.positions(body.sheet));
      body.model.assemble(0, 1);
      const Eigen::MatrixXd stiffness = dense(body.model);
      Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(n, n);  // freed slots have no stiffness
      for (Eigen::Index i = 0; i < n; ++i)
        if (body.model.lumped_mass()[i / 3] > 0) mass(i, i) = body.model.lumped_mass()[i / 3];
      const double expected = largest_mode(stiffness, mass) * skin.density / skin.stiffness;
      EXPECT_NEAR(largest_eigenvalue(body.sheet, {}, elasticity_of(skin, kind)), expected, 1e-3 * expected);
    }
}

/// Runs just below and just above the predicted step, of a sheet with slivers and bending.
TEST(LargestEigenvalue, IsWhereExplicitStepsBreakDown) {
  for (const std::string method : {"conventional_split", "warp_and_refine"})
    for (const double damping : {0.0, 1e-5}) {
      Material material = skin;
      material.bending = 1;
      material.mass_damping = 1e4 * damping;
      material.stiffness_damping = damping;
      const auto grows = [&](double factor) {
        Body<3> body(make_sheet("grid", 8), material, {.strain = Strain::linear, .bending = BendingKind::patches});
        EXPECT_EQ(body.cut(line({0.21, 0.27}, {0.83, 0.71}), method, find_method(method).parameter.value), Status::ok);
        const double with = largest_eigenvalue(body.sheet, {}, elasticity_of(material, BendingKind::patches));
        EXPECT_GT(with, 1.5 * largest_eigenvalue(body.sheet, {}, elasticity_of(material, BendingKind::none)));
        const double step = factor * explicit_step_limit(with, material);
        Stepper<3> stepper({.integrator = Integrator::symplectic_euler, .step = step, .solver = {}});
        for (Eigen::Index i = 0; i < body.state.v.size(); ++i) body.state.v[i] = 1e-3 * std::sin(to_double(37 * i * i));
        const double initial = balance_of(body.model, body.state).energy.total();
        for (int n = 0; n < 400; ++n) EXPECT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
        return balance_of(body.model, body.state).energy.total() > 100 * initial;
      };
      EXPECT_FALSE(grows(0.98)) << method << damping;
      EXPECT_TRUE(grows(1.02)) << method << damping;
    }
}

}  // namespace
}  // namespace cutbench
