// The matrix of bending: rigid motions and nothing else cost nothing, its energy, one hinge by hand, and incisions.

#include "harness/fem/elements/bending.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/bending_helpers.h"
#include "tests/dense_solves.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

Eigen::SparseMatrix<double> sparse(const BlockMatrix<1>& k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < k.rows(); ++i)
    for (const std::int32_t j : k.columns(i)) entries.emplace_back(to_int(i), j, k.block(k.find(i, j))(0));
  const auto n = to_index(k.rows());
  Eigen::SparseMatrix<double> result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Functions that are linear on each piece, with slopes of its own.
Field rigid(const Sheet& sheet, Random& random) {
  std::vector<std::size_t> piece(sheet.deformed_slots());
  std::iota(piece.begin(), piece.end(), std::size_t{0});
  const std::function<std::size_t(std::size_t)> root = [&](std::size_t i) {
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  for_each_triangle(sheet, [&](const Triangle& t, const auto&) {
    piece[root(t.deformed[0]())] = root(t.deformed[1]());
    piece[root(t.deformed[1]())] = root(t.deformed[2]());
  });
  std::map<std::size_t, std::array<double, 3>> slopes;
  Field x = Field::Zero(to_index(sheet.deformed_slots()));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const VertexIndex v = sheet.rest_vertex(DeformedIndex(d));
    if (!v.valid()) continue;
    const auto [at, is_new] = slopes.try_emplace(root(d));
    if (is_new)
      for (double& s : at->second) s = random.between(-1, 1);
    const auto& [a, b, c] = at->second;
    x[to_index(d)] = a + b * sheet.rest(v).x + c * sheet.rest(v).y;
  }
  return x;
}

void expect_symmetric_and_rigid(const Sheet& sheet, const Bending& bending) {
  const BlockMatrix<1>& k = bending.matrix();
  const double largest = max_entry(k);
  ASSERT_TRUE(std::isfinite(largest));
  ASSERT_GT(largest, 0);
  double asymmetry = 0;
  for (std::size_t i = 0; i < k.rows(); ++i) {
    EXPECT_TRUE(k.columns(i).empty() || sheet.rest_vertex(DeformedIndex(i)).valid());
    for (const std::int32_t j : k.columns(i)) {
      const std::int32_t mirrored = k.find(to_size(j), to_int32(i));
      ASSERT_GE(mirrored, 0);
      asymmetry = std::max(asymmetry, std::abs(k.block(k.find(i, j))(0) - k.block(mirrored)(0)));
    }
  }
  EXPECT_EQ(asymmetry, 0);
  Random random(3);
  for (int i = 0; i < 3; ++i) {
    const Field x = rigid(sheet, random);
    Field force = Field::Zero(x.size());
    k.add_product(1, x, force);
    EXPECT_LE(force.cwiseAbs().maxCoeff(), 1e-12 * largest);
  }
}

TEST(Bending, IsSymmetricAndRigidMotionsCostNothing) {
  for (const std::string family : sheet_families()) {
    SCOPED_TRACE(family);
    const Sheet sheet(make_sheet(family, 8));
    expect_symmetric_and_rigid(sheet, patches(sheet));
    expect_symmetric_and_rigid(sheet, hinges(sheet));
  }
  for (const Cut& cut : cut_sheets(6, 1)) {
    SCOPED_TRACE(cut.name);
    expect_symmetric_and_rigid(cut.sheet, patches(cut.sheet));
    expect_symmetric_and_rigid(cut.sheet, hinges(cut.sheet));
  }
}

/// Eigenvalues: none negative, zero three times per piece.
TEST(Bending, NothingElseCostsNothing) {
  const auto check = [](const Sheet& sheet, const std::string& name) {
    SCOPED_TRACE(name);
    const Eigen::MatrixXd k = sparse(patches(sheet).matrix()).toDense();
    const Field values = eigenvalues(k);
    const double largest = values.maxCoeff();
    EXPECT_GE(values.minCoeff(), -1e-12 * largest);
    const auto freed = static_cast<long>(sheet.deformed_slots() - sheet.deformed_count());
    EXPECT_EQ((values.array() < 1e-10 * largest).count() - freed, 3 * static_cast<long>(count_pieces(sheet)));
  };
  for (const std::string family : sheet_families()) check(Sheet(make_sheet(family, 7)), family);
  for (const Cut& cut : cut_sheets(5, 1))  // with slivers, what is soft is lost in round-off
    if (smallest_altitude(cut.sheet) > 0.03) check(cut.sheet, cut.name);
}

TEST(Bending, EnergyIsThatOfTheMatrix) {
  const Sheet sheet(make_sheet("delaunay", 8));
  const Field x = cylinder(sheet, 20, 1), y = cylinder(sheet, 70, -2),
              z = sampled(sheet, [](Point2 p) { return std::sin(3 * p.x) * p.y; });
  Field all(3 * x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) all.segment<3>(3 * i) << x[i], y[i], z[i];
  for (const Bending& bending : {patches(sheet), hinges(sheet)}) {
    const double expected = form(bending.matrix(), x) + form(bending.matrix(), y) + form(bending.matrix(), z);
    EXPECT_NEAR(bending.energy(all, 3), expected, 1e-12 * expected);
  }
}

/// Bergou's cotangents, one hinge by hand.
TEST(Bending, AHingeIsBergous) {
  MeshData mesh;
  mesh.rest = {{0, 0}, {2, 0.1}, {0.7, 1.1}, {0.9, -0.8}};
  for (Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  const Sheet sheet(mesh);
  const auto& p = mesh.rest;
  const auto cotangent = [&](std::size_t at, std::size_t a, std::size_t b) {
    return dot(p[a] - p[at], p[b] - p[at]) / std::abs(cross(p[a] - p[at], p[b] - p[at]));
  };
  const double c01 = cotangent(0, 1, 2), c02 = cotangent(0, 1, 3), c03 = cotangent(1, 0, 2), c04 = cotangent(1, 0, 3);
  const Eigen::Vector4d c(c03 + c04, c01 + c02, -c01 - c03, -c02 - c04);
  const double areas = area({p[0], p[1], p[2]}) + area({p[1], p[0], p[3]});
  const Eigen::Matrix4d expected = rigidity * 3 / areas * c * c.transpose();
  const Eigen::MatrixXd k = sparse(hinges(sheet).matrix()).toDense();
  EXPECT_LE((k - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(Bending, NothingHoldsAcrossAnIncision) {
  for (const MethodRow& row : whole_sheet_methods()) {
    Sheet sheet(make_sheet("delaunay", 10));
    Locator locator(sheet);
    Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{-0.1, 0.41}, {1.1, 0.52}}},
                 *row.make(row.parameter.value), {});
    ASSERT_EQ(count_pieces(sheet), 2u);
    for (const Bending& bending : {patches(sheet), hinges(sheet)}) {
      std::vector<int> side(sheet.deformed_slots());
      for_each_triangle(sheet, [&](const Triangle& t, const auto& c) {
        const Point2 centre = 1.0 / 3 * (c[0] + c[1] + c[2]);
        const int s = centre.y > 0.41 + 0.11 / 1.2 * (centre.x + 0.1) ? 1 : -1;
        for (const DeformedIndex d : t.deformed) side[d()] = s;
      });
      for (std::size_t i = 0; i < side.size(); ++i)
        for (const std::int32_t j : bending.matrix().columns(i)) EXPECT_EQ(side[i], side[to_size(j)]);
    }
  }
}

TEST(BendingKinds, NamesAndRowsAreThoseOfTheirPlace) {
  EXPECT_STREQ(name_of(BendingKind::none), "none");
  EXPECT_STREQ(name_of(BendingKind::patches), "patches");
  EXPECT_STREQ(name_of(BendingKind::hinges), "hinges");
  EXPECT_TRUE(row_of(BendingKind::patches).has_slopes);
  EXPECT_FALSE(row_of(BendingKind::hinges).has_slopes);
  for (const auto& [kind, name] : bending_names()) {
    EXPECT_STREQ(name_of(kind), name);
    EXPECT_EQ(row_of(kind).add_rows == nullptr, kind == BendingKind::none) << name;
  }
}

}  // namespace
}  // namespace cutbench
