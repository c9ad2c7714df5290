// What smooths on a level of multigrid, against dense matrices: sweeps and stiff clusters. (packed_rows_test.cpp
// compares the sweeps' bits with plain loops.)

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/multigrid/packed_kernel.h"
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
  SweptScalars swept;
  swept.follow(rows);
  SweepOrder order;
  order.follow(rows, swept);
  PackedRows<3, S> a;
  a.follow(rows, swept, order, true);
  std::vector<double> values(9 * rows.blocks.slots());
  for (double& value : values) value = random.between(-1, 1);
  for (std::size_t i = 0; i < n; ++i)
    a.fill_row(i, [&](std::size_t slot) { return columns_of<3>(values.data() + 9 * slot); });
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i) {
    const auto row = to_size(i);
    a.for_each_block(row,
                     [&](int j, const auto& block) { all.block<3, 3>(3 * i, 3 * j) += block.template cast<double>(); });
    a.for_each_scalar(row, [&](int j, S value) { all.block<3, 3>(3 * i, 3 * j).diagonal().array() += double(value); });
  }
  Eigen::MatrixXd with_small = all;  // which the swept matrix has on its diagonal
  for (std::size_t i = 0; i < n; ++i) {
    with_small.block<3, 3>(to_index(3 * i), to_index(3 * i)).diagonal().array() -= swept.left_out(i);
    std::size_t slot = rows.scalars.first_slot(i);
    for (const std::int32_t j : rows.scalars[i]) {
      const double value = rows.scalar[slot++];
      if (to_size(j) != i && swept.is_small(i, to_size(j), value))
        with_small.block<3, 3>(to_index(3 * i), 3 * j).diagonal().array() += value;
    }
  }
  EXPECT_GT((all - with_small).cwiseAbs().maxCoeff(), 0.1);
  Eigen::MatrixXd lower = Eigen::MatrixXd::Identity(3 * n, 3 * n), upper = lower;  // with the blocks on the diagonal
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i == 5 || j == 5) continue;
      if (i >= j) lower.block<3, 3>(3 * i, 3 * j) = all.block<3, 3>(3 * i, 3 * j);
      if (i <= j) upper.block<3, 3>(3 * i, 3 * j) = all.block<3, 3>(3 * i, 3 * j);
    }
  for (std::size_t i = 0; i < n; ++i)
    if (i != 5) a.set_inverse(i, a.diagonal(i).inverse());

  const Eigen::Index size = 3 * n;
  const auto flat = [&](const PackedVector<S>& v) {
    Field field(size);
    for (Eigen::Index u = 0; u < size; ++u) field[u] = double(v[to_size(u / 3)][u % 3]);
    return field;
  };
  PackedVector<S> r(n), z(n), t(n);
  const Field right = random_field(4, size);
  for (Eigen::Index u = 0; u < size; ++u) r[to_size(u / 3)][u % 3] = u / 3 == 5 ? S(0) : static_cast<S>(right[u]);
  const double close = std::is_same_v<S, float> ? 1e-5 : 1e-13;
  sweep_forwards<Widest<S>>(a, r, z, t);
  const Field first = lower.lu().solve(flat(r));
  EXPECT_LT((flat(z) - first).norm(), close * first.norm());
  EXPECT_LT((flat(t) - (flat(r) - all * first)).norm(), 30 * close * flat(r).norm());
  const Field start = flat(z);
  sweep_backwards<Widest<S>>(a, r, z);
  const Field second = start + upper.lu().solve(flat(r) - all * start);
  EXPECT_LT((flat(z) - second).norm(), close * second.norm());
  for (std::size_t i = 0; i < n; ++i) t[i] = row_product<Widest<S>>(a, i, r);
  EXPECT_LT((flat(t) - with_small * flat(r)).norm(), close * flat(t).norm());
}

/// Small scalars go to the diagonals of both rows or of none, also where one of them has changed since.
TEST(SweptScalars, LeaveSmallOnesOut) {
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
  SweptScalars a;
  a.follow(rows);
  const auto taken = [&] {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
    for (std::int32_t i = 0; i < n; ++i) {
      std::size_t slot = a.rows().first_slot(to_size(i));
      for (const std::int32_t j : a.rows()[to_size(i)]) all(i, j) = a.values()[slot++];
    }
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
  EXPECT_EQ((taken().array() != 0).count(), n * n / 2);

  // A cut makes slivers of one row, and takes most of another.
  scalars(3, 3) *= 1e4;
  scalars(8, 8) *= 1e-4;
  std::vector<std::int32_t> changed{3, 8};
  for (const std::int32_t i : changed) set(i);
  a.follow(rows, changed);
  EXPECT_EQ(taken(), taken().transpose());
  for (const int i : {3, 8}) EXPECT_NEAR(taken().row(i).sum(), scalars.row(i).sum(), 1e-10);
  EXPECT_EQ(taken()(3, 7), scalars(3, 7));
}

// --- stiff clusters --------------------------------------------------------------------------------------------------

/// The corrections are those of dense solves, one cluster after the other, and the residual that is kept is the true
/// one.
TEST(StiffClusters, AreSolvedExactly) {
  const Body<2> body = cut_body<2>("delaunay", 20, BendingKind::none, "conventional_split");
  const SystemMatrix<2> a = body.model.system();
  const LevelRows rows = rows_of(*a.blocks);
  SweptScalars swept;
  swept.follow(rows);
  SweepOrder order;
  order.follow(rows, swept);
  PackedRows<2, double> matrix;
  matrix.follow(rows, swept, order, false);
  const auto n = to_index(2 * a.vertices());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    matrix.fill_row(i, [&](std::size_t slot) {
      const std::int32_t j = rows.blocks[i][slot - rows.blocks.first_slot(i)];
      const auto& block = a.blocks->block(a.blocks->find(i, j));
      all.block<2, 2>(to_index(2 * i), 2 * j) = block;
      return columns_of<2>(block.data());
    });
  }
  const std::vector<std::uint8_t> nothing_held(a.held->size(), 0);
  StiffClusters<2> clusters;
  std::vector<double> sizes(a.vertices());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = a.diagonal(i).trace();
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  clusters.find(sizes, sorted[sorted.size() / 2], rows);
  ASSERT_GT(clusters.size(), 2u);
  clusters.factor(matrix, nothing_held);

  const Field right = random_field(9, n);
  const auto packed = [&](const Field& field) {
    PackedVector<double> vector(a.vertices());
    for (Eigen::Index u = 0; u < n; ++u) vector[to_size(u / 2)][u % 2] = field[u];
    return vector;
  };
  const auto flat = [&](const PackedVector<double>& vector) {
    Field field(n);
    for (Eigen::Index u = 0; u < n; ++u) field[u] = vector[to_size(u / 2)][u % 2];
    return field;
  };
  PackedVector<double> z(a.vertices()), t = packed(right);
  clusters.correct_forwards(matrix, z, t);
  const Field forwards = flat(z);
  EXPECT_LT((flat(t) - (right - all * forwards)).norm(), 1e-9 * right.norm());
  // Each correction is the best in its space, so the energy that is left falls by half of r.z in the end.
  EXPECT_GT(right.dot(forwards), 0);
  EXPECT_LT(forwards.dot(all * forwards) / 2 - right.dot(forwards), 0);
  // Backwards after forwards is symmetric: B = B^T for the residuals r and q.
  const auto both = [&](const Field& from) {
    PackedVector<double> x(a.vertices()), left = packed(from);
    clusters.correct_forwards(matrix, x, left);
    clusters.correct_backwards(matrix, packed(from), x);
    return flat(x);
  };
  const Field q = random_field(10, n), from_r = both(right), from_q = both(q);
  EXPECT_NEAR(q.dot(from_r), right.dot(from_q), 1e-9 * std::sqrt(q.dot(from_q) * right.dot(from_r)));
  // Once more changes nothing at the last cluster solved, which is the first: its residual is zero.
  std::size_t solved = 0;
  const Field left = right - all * from_r;
  for (Eigen::Index u = 0; u < n; ++u) solved += std::abs(left[u]) < 1e-9 * right.norm() && from_r[u] != 0;
  EXPECT_GE(solved, 4u);
}

/// Two vertices that hold each other far more than anything holds both: the last pivots are the sum of what does.
TEST(StiffClusters, SmallestPivot) {
  constexpr double together = 1e6, apart = 1;
  LevelRows rows;
  rows.resize(2);
  const std::vector<std::int32_t> both{0, 1};
  for (const std::size_t i : {0, 1}) rows.blocks.set(i, both);
  SweptScalars swept;
  swept.follow(rows);
  SweepOrder order;
  order.follow(rows, swept);
  PackedRows<2, double> matrix;
  matrix.follow(rows, swept, order, false);
  for (const std::size_t i : {0, 1})
    matrix.fill_row(i, [&](std::size_t slot) {
      const bool is_own = slot == rows.blocks.diagonal_slot(i);
      const Eigen::Matrix2d block = (is_own ? together + apart : -together) * Eigen::Matrix2d::Identity();
      return columns_of<2>(block.data());
    });
  StiffClusters<2> clusters;
  EXPECT_EQ(clusters.smallest_pivot(), 1);
  clusters.find({together, together}, apart, rows);
  ASSERT_EQ(clusters.size(), 1u);
  clusters.factor(matrix, std::vector<std::uint8_t>(4, 0));
  EXPECT_NEAR(clusters.smallest_pivot(), 2 * apart / together, 1e-3 * apart / together);
}

}  // namespace
}  // namespace cutbench
