// The largest eigenvalue of (K, M), against a dense solve of matrices put together here from strain-displacement
// matrices.

#include "harness/fem/largest_eigenvalue.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/dense_solves.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

double by_dense_solve(const MeshData& mesh) {
  const auto n = static_cast<Eigen::Index>(2 * mesh.rest.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), mass = stiffness;
  Eigen::Matrix3d law;  // plane stress, E h = 1, nu = 0.3
  law << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  law /= 1 - 0.3 * 0.3;
  for (const auto& t : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const Point2 p = mesh.rest[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
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
    const auto unknown = [&](int i) { return 2 * t[static_cast<std::size_t>(i / 2)] + i % 2; };
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
        Table table(make_sheet(family, 7), find_method(method), find_method(method).knob.value);
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

}  // namespace
}  // namespace cutbench
