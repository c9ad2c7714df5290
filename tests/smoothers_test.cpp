// What smooths on a level of multigrid, against dense matrices: sweeps and stiff clusters.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/multigrid/level_matrix.h"
#include "harness/fem/multigrid/stiff_clusters.h"
#include "tests/multigrid_helpers.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

// --- a level's matrix ------------------------------------------------------------------------------------------------

template <class S>
class Sweeps : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Sweeps, Scalars, );

TYPED_TEST(Sweeps, AreTriangularSolves) {
  using S = TypeParam;
  constexpr int n = 12;
  Random random(3);
  LevelRows rows;
  rows.resize(n);
  for (std::int32_t i = 0; i < n; ++i) {
    std::vector<std::int32_t> blocks, scalars;
    std::vector<double> values;
    for (std::int32_t j = n - 1; j >= 0; --j) {
      if (i != 5 && j != 5 && (i == j || (i + j) % 3 == 0)) blocks.push_back(j);
      if (i != 5 && j != 5 && (i == j || (i * j) % 4 == 1)) {
        scalars.push_back(j);
        values.push_back(random.between(20, 30));
      }
      if (i != 5 && j != 5 && (i * j) % 4 == 3) {
        scalars.push_back(j);
        values.push_back(random.between(0.1, 0.15));
      }
    }
    rows.blocks.set(to_size(i), blocks);
    rows.set_scalars(to_size(i), scalars, values);
  }
  LevelMatrix<3, S> a;
  a.follow(rows);
  for (std::size_t k = 0; k < 9 * rows.blocks.slots(); ++k) a.block(0)[k] = static_cast<S>(random.between(-1, 1));
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i) {
    const auto row = to_size(i);
    a.for_each_block(row,
                     [&](int j, const auto& block) { all.block<3, 3>(3 * i, 3 * j) += block.template cast<double>(); });
    a.for_each_scalar(row, [&](int j, S value) { all.block<3, 3>(3 * i, 3 * j).diagonal().array() += double(value); });
  }
  EXPECT_GT((all - a.dense()).cwiseAbs().maxCoeff(), 0.1);                         // small scalars are on the diagonal
  Eigen::MatrixXd lower = Eigen::MatrixXd::Identity(3 * n, 3 * n), upper = lower;  // with the blocks on the diagonal
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i == 5 || j == 5) continue;
      if (i >= j) lower.block<3, 3>(3 * i, 3 * j) = all.block<3, 3>(3 * i, 3 * j);
      if (i <= j) upper.block<3, 3>(3 * i, 3 * j) = all.block<3, 3>(3 * i, 3 * j);
    }
  for (std::size_t i = 0; i < n; ++i)
    if (i != 5) a.set_inverse(i, a.diagonal(i).inverse());

  using Vector = typename LevelMatrix<3, S>::Vector;
  const Eigen::Index size = 3 * n;
  const auto values = [&](const Vector& v) {
    return Field(Eigen::Map<const Eigen::Matrix<S, Eigen::Dynamic, 1>>(v.data(), size).template cast<double>());
  };
  Vector r(3 * n + LevelMatrix<3, S>::padding), z = r, t = r;
  const Field right = random_field(4, size);
  for (Eigen::Index u = 0; u < size; ++u) r[to_size(u)] = u / 3 == 5 ? S(0) : static_cast<S>(right[u]);
  const double close = std::is_same_v<S, float> ? 1e-5 : 1e-13;
  a.sweep_forwards(r, z, t);
  const Field first = lower.triangularView<Eigen::Lower>().solve(Field::Zero(size)) + lower.lu().solve(values(r));
  EXPECT_LT((values(z) - first).norm(), close * first.norm());
  EXPECT_LT((values(t) - (values(r) - all * first)).norm(), 30 * close * values(r).norm());
  const Field start = values(z);
  a.sweep_backwards(r, z);
  const Field second = start + upper.lu().solve(values(r) - all * start);
  EXPECT_LT((values(z) - second).norm(), close * second.norm());
}

/// Small scalars go to the diagonals of both rows or of none, also where one of them has changed since. The dense
/// matrix has them all where they were.
TEST(LevelMatrix, LeavesSmallScalarsOut) {
  constexpr std::int32_t n = 30;
  Random random(8);
  LevelRows rows;
  rows.resize(n);
  Eigen::MatrixXd scalars = Eigen::MatrixXd::Zero(n, n);
  for (std::int32_t i = 0; i < n; ++i) {
    scalars(i, i) = random.between(1, 2);
    for (std::int32_t j = 0; j < i; ++j)
      scalars(i, j) = scalars(j, i) = (i + j) % 2 ? random.between(-0.005, 0.005) : random.between(0.1, 0.2);
  }
  const auto set = [&](std::int32_t i) {
    std::vector<std::int32_t> columns(n);
    std::vector<double> values(n);
    for (std::int32_t j = 0; j < n; ++j) {
      columns[to_size(j)] = j;
      values[to_size(j)] = scalars(i, j);
    }
    rows.blocks.set(to_size(i), columns);
    rows.set_scalars(to_size(i), columns, values);
  };
  for (std::int32_t i = 0; i < n; ++i) set(i);
  LevelMatrix<2, double> a;
  a.follow(rows);
  const auto taken = [&] {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
    for (std::int32_t i = 0; i < n; ++i)
      a.for_each_scalar(to_size(i), [&](std::int32_t j, double value) { all(i, j) = value; });
    return all;
  };
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = 0; j < n; ++j)
      if (i != j) {
        EXPECT_EQ(taken()(i, j), (i + j) % 2 ? 0 : scalars(i, j));
      }
    EXPECT_NEAR(taken().row(i).sum(), scalars.row(i).sum(), 1e-14);  // a translation is what it was
    EXPECT_NEAR(a.left_out(to_size(i)), taken()(i, i) - scalars(i, i), 1e-14);
  }
  EXPECT_EQ(a.scalar_count(), to_size(n * n / 2));

  // A cut makes slivers of one row, and takes most of another.
  scalars(3, 3) *= 1e4;
  scalars(8, 8) *= 1e-4;
  std::vector<std::int32_t> changed{3, 8};
  for (const std::int32_t i : changed) set(i);
  a.follow(rows, changed);
  EXPECT_EQ(taken(), taken().transpose());
  for (const int i : {3, 8}) EXPECT_NEAR(taken().row(i).sum(), scalars.row(i).sum(), 1e-10);
  EXPECT_EQ(taken()(3, 7), scalars(3, 7));
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < n; ++j) EXPECT_EQ(a.dense()(2 * i, 2 * j), scalars(i, j));
}

// --- stiff clusters --------------------------------------------------------------------------------------------------

/// The corrections are those of dense solves, one cluster after the other, and the residual that is kept is the true
/// one.
TEST(StiffClusters, AreSolvedExactly) {
  const Body<2> body = cut_body<2>("delaunay", 20, BendingKind::none, "conventional_split");
  const SystemMatrix<2> a = body.model.system();
  const LevelRows rows = rows_of(*a.blocks);
  LevelMatrix<2, double> matrix;
  matrix.follow(rows);
  for (std::size_t i = 0; i < a.vertices(); ++i)
    for (std::size_t k = 0; k < rows.blocks[i].size(); ++k)
      Eigen::Map<Eigen::Matrix2d>(matrix.block(rows.blocks.first_slot(i) + k)) =
          a.blocks->block(a.blocks->find(i, rows.blocks[i][k]));
  const std::vector<std::uint8_t> nothing_held(a.held->size(), 0);
  StiffClusters<2> clusters;
  std::vector<double> sizes(a.vertices());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = a.diagonal(i).trace();
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  clusters.find(sizes, sorted[sorted.size() / 2], rows);
  ASSERT_GT(clusters.size(), 2u);
  clusters.factor(matrix, nothing_held);

  const auto n = to_index(2 * a.vertices());
  const Eigen::MatrixXd all = matrix.dense();
  const Field right = random_field(9, n);
  std::vector<double> r(to_size(n) + 4), z(r.size()), t(r.size());
  Eigen::Map<Field>(r.data(), n) = right;
  t = r;
  clusters.correct_forwards(matrix, z, t);
  const Field forwards = Eigen::Map<const Field>(z.data(), n);
  EXPECT_LT((Eigen::Map<const Field>(t.data(), n) - (right - all * forwards)).norm(), 1e-9 * right.norm());
  // Each correction is the best in its space, so the energy that is left falls by half of r.z in the end.
  EXPECT_GT(right.dot(forwards), 0);
  EXPECT_LT(forwards.dot(all * forwards) / 2 - right.dot(forwards), 0);
  // Backwards after forwards is symmetric: B = B^T for the residuals r and q.
  const auto both = [&](const Field& from) {
    std::vector<double> x(r.size()), left(r.size()), start(r.size());
    Eigen::Map<Field>(left.data(), n) = from;
    start = left;
    clusters.correct_forwards(matrix, x, left);
    clusters.correct_backwards(matrix, start, x);
    return Field(Eigen::Map<const Field>(x.data(), n));
  };
  const Field q = random_field(10, n), from_r = both(right), from_q = both(q);
  EXPECT_NEAR(q.dot(from_r), right.dot(from_q), 1e-9 * std::sqrt(q.dot(from_q) * right.dot(from_r)));
  // Once more changes nothing at the last cluster solved, which is the first: its residual is zero.
  std::size_t solved = 0;
  const Field left = right - all * from_r;
  for (Eigen::Index u = 0; u < n; ++u) solved += std::abs(left[u]) < 1e-9 * right.norm() && from_r[u] != 0;
  EXPECT_GE(solved, 4u);
}

}  // namespace
}  // namespace cutbench
