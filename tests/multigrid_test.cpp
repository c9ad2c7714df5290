// The levels and sweeps of multigrid against dense matrices, its cycle as a preconditioner, and solves after cuts.

#include "harness/fem/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "harness/base/random.h"
#include "harness/cases/mixture.h"
#include "harness/fem/linear_solver.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

std::vector<Pin> held_left() {
  Pin pin;
  pin.where = {{-1, -1}, {1e-9, 2}};
  return {pin};
}

Field random_field(std::uint64_t seed, Eigen::Index size) {
  Random random(seed);
  Field f(size);
  for (double& value : f) value = random.between(-1, 1);
  return f;
}

/// A sheet after a cut right through and one that ends inside, pulled out of its plane, with the matrix of a step.
template <int D>
Body<D> cut_body(const std::string& family, int n, BendingKind bending, const std::string& method) {
  Body<D> body(make_sheet(family, n), skin, {.bending = bending}, held_left());
  EXPECT_EQ(body.cut(line({-0.1, 0.313}, {1.1, 0.741}), method), Status::ok);
  EXPECT_EQ(body.cut(line({0.31, 0.1}, {0.52, 0.57}), method), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  body.model.assemble(1, 1e-3);
  return body;
}

template <int D>
Eigen::MatrixXd dense(const SystemMatrix<D>& a) {
  const auto n = static_cast<Eigen::Index>(D * a.vertices());
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Field column = Field::Zero(n);
    if (!(*a.held)[static_cast<std::size_t>(k)]) {
      Field unit = Field::Zero(n);
      unit[k] = 1;
      a.multiply(unit, column);
    }
    all.col(k) = column;
  }
  return all;
}

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
      if (i != 5 && j != 5 && (i == j || (i * j) % 4 == 1))
        scalars.push_back(j), values.push_back(random.between(20, 30));
    }
    rows.blocks.set(static_cast<std::size_t>(i), blocks);
    rows.set_scalars(static_cast<std::size_t>(i), scalars, values);
  }
  LevelMatrix<3, S> a;
  a.follow(rows);
  for (std::size_t k = 0; k < 9 * rows.blocks.slots(); ++k) a.block(0)[k] = static_cast<S>(random.between(-1, 1));
  const Eigen::MatrixXd all = a.dense();
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
  for (Eigen::Index u = 0; u < size; ++u) r[static_cast<std::size_t>(u)] = u / 3 == 5 ? S(0) : static_cast<S>(right[u]);
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

// --- coarse unknowns -------------------------------------------------------------------------------------------------

LevelRows rows_of(const BlockMatrix<2>& a) {
  LevelRows rows;
  rows.resize(a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i) rows.blocks.set(i, a.columns(i));
  return rows;
}

RowChanges all_of(const LevelRows& rows) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  return {all, all};
}

/// The hats' place and value by another way: the distance to the three pairs of lines of a node's hexagon.
double hat(Point2 p, Point2 node, double spacing) {
  double least = 1;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3 + std::numbers::pi / 6;
    const double along = (p.x - node.x) * std::cos(angle) + (p.y - node.y) * std::sin(angle);
    least = std::min(least, 1 - along / (spacing * std::sqrt(3) / 2));
  }
  return std::max(0.0, least);
}

TEST(Coarsening, PartsOfHatsAsAFloodFillFindsThem) {
  for (const std::string family : {"grid", "delaunay", "graded"}) {
    SCOPED_TRACE(family);
    const Body<2> body = cut_body<2>(family, 24, BendingKind::none, "conventional_split");
    const SystemMatrix<2> a = body.model.system();
    const LevelRows rows = rows_of(*a.blocks);
    const SweepRows& links = rows.blocks;
    const double spacing = 2.0 / 24;
    Coarsening coarsening(spacing);
    coarsening.update(rows, *a.places, all_of(rows));
    std::size_t divided = 0;
    std::map<std::pair<long, long>, int> parts_at;
    for (std::size_t k = 0; k < coarsening.coarse_size(); ++k) {
      const Point2 node = coarsening.coarse_places()[k];
      divided += ++parts_at[{std::lround(1e6 * node.x), std::lround(1e6 * node.y)}] == 2;
      std::set<std::int32_t> members;
      for (const auto& [v, weight] : coarsening.members(k)) {
        EXPECT_NEAR(weight, hat((*a.places)[static_cast<std::size_t>(v)], node, spacing), 1e-6);
        members.insert(v);
      }
      std::vector<std::int32_t> front{*members.begin()};
      std::set<std::int32_t> reached(front.begin(), front.end());
      while (!front.empty()) {
        const auto v = static_cast<std::size_t>(front.back());
        front.pop_back();
        for (const std::int32_t other : links[v])
          if (hat((*a.places)[static_cast<std::size_t>(other)], node, spacing) > 2e-5 && reached.insert(other).second)
            front.push_back(other);
      }
      EXPECT_EQ(reached, members);
    }
    EXPECT_GT(divided, 10u) << "nodes over an incision";
    for (std::size_t v = 0; v < a.vertices(); ++v) {
      if (links[v].empty()) continue;
      double sum = 0;
      Point2 mean;
      for (const auto& [k, weight] : coarsening.parents(v)) {
        sum += weight;
        mean = mean + double(weight) * coarsening.coarse_places()[static_cast<std::size_t>(k)];
      }
      EXPECT_NEAR(sum, 1, 1e-4);
      EXPECT_LT(length(mean - (*a.places)[v]), 1e-4 * spacing) << "linear functions are interpolated exactly";
    }
  }
}

TEST(Coarsening, PatternIsThatOfTheProduct) {
  const Body<2> body = cut_body<2>("delaunay", 12, BendingKind::none, "conventional_split");
  const SystemMatrix<2> a = body.model.system();
  LevelRows fine = rows_of(*a.blocks);
  const SweepRows& links = fine.blocks;
  const auto n = static_cast<Eigen::Index>(links.size());
  Random random(2);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<double> values;
    for (const std::int32_t j : a.blocks->columns(static_cast<std::size_t>(i)))
      values.push_back(matrix(i, j) = random.between(-1, 1));
    fine.set_scalars(static_cast<std::size_t>(i), a.blocks->columns(static_cast<std::size_t>(i)), values);
  }
  Coarsening coarsening(2.0 / 12);
  coarsening.update(fine, *a.places, all_of(fine), {{}, {{0, 1, 2}}});
  const Eigen::Index group = coarsening.group_of(1);
  ASSERT_GE(group, 0);
  EXPECT_EQ(coarsening.group_of(3), -1);
  const auto m = static_cast<Eigen::Index>(coarsening.coarse_size());
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(n, m), graph = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [k, weight] : coarsening.parents(static_cast<std::size_t>(i))) p(i, k) = 1;
    for (const std::int32_t j : links[static_cast<std::size_t>(i)]) graph(i, j) = 1;
  }
  for (const Eigen::Index v : {0, 1, 2}) EXPECT_EQ(p(v, group), 1);
  EXPECT_EQ(p.col(group).sum(), 3);
  const Eigen::MatrixXd product = p.transpose() * graph * p;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, m);
  for (Eigen::Index i = 0; i < n; ++i)
    for (const auto& [k, weight] : coarsening.parents(static_cast<std::size_t>(i))) weights(i, k) = double(weight);
  LevelRows coarse;
  coarsening.multiply(fine, coarse);
  const Eigen::MatrixXd exact = weights.transpose() * matrix * weights;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    for (std::size_t k = 0; k < coarse.scalars[i].size(); ++k)
      EXPECT_NEAR(coarse.scalar[coarse.scalars.first_slot(i) + k],
                  exact(static_cast<Eigen::Index>(i), coarse.scalars[i][k]), 1e-12);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto row = coarse.blocks[static_cast<std::size_t>(i)];
    const auto scalars = coarse.scalars[static_cast<std::size_t>(i)];
    EXPECT_TRUE(std::is_permutation(row.begin(), row.end(), scalars.begin(), scalars.end()));
    const auto side = [i](std::int32_t j) { return (j > i) - (j < i); };
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end(), [&](auto one, auto other) { return side(one) < side(other); }));
    for (Eigen::Index j = 0; j < m; ++j)
      EXPECT_EQ(std::count(row.begin(), row.end(), static_cast<std::int32_t>(j)), product(i, j) > 0 ? 1 : 0);
  }
}

/// A coarse unknown by what it is for, not by its number: its members, with their weights.
using Part = std::vector<std::pair<std::int32_t, float>>;

Part part_of(const Coarsening& coarsening, std::size_t coarse) {
  Part part;
  for (const auto& [fine, weight] : coarsening.members(coarse)) part.emplace_back(fine, weight);
  std::sort(part.begin(), part.end());
  return part;
}

/// Rows of the coarse matrix, with its unknowns by their members.
std::map<Part, std::map<Part, double>> product_of(const Coarsening& coarsening, const LevelRows& coarse) {
  std::map<Part, std::map<Part, double>> all;
  for (std::size_t i = 0; i < coarsening.coarse_size(); ++i) {
    if (coarsening.members(i).empty()) {
      EXPECT_TRUE(coarse.blocks[i].empty() && coarse.scalars[i].empty());
      continue;
    }
    auto& row = all[part_of(coarsening, i)];
    for (std::size_t k = 0; k < coarse.scalars[i].size(); ++k)
      row[part_of(coarsening, static_cast<std::size_t>(coarse.scalars[i][k]))] =
          coarse.scalar[coarse.scalars.first_slot(i) + k];
    EXPECT_EQ(coarse.blocks[i].size(), coarse.scalars[i].size());
  }
  return all;
}

/// Two coarsenings in a row follow a sheet through cuts, and are what new ones are. All links have the value of one more
/// than the number of the cut after which they came, so that old ones would be noticed.
TEST(Coarsening, FollowsTheCuts) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "bowyer_watson", "element_deletion"}) {
    SCOPED_TRACE(method);
    constexpr double spacing = 2.0 / 30;
    Body<2> body(make_sheet("delaunay", 30), skin, {}, {});
    Coarsening first(spacing), second(2 * spacing);
    LevelRows fine, coarse, coarsest;
    std::uint64_t seen = 0;
    std::size_t n = 0;
    double value = 1;
    std::vector<Point2> places;
    for (const Curve& curve : {line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                               line({0.52, 0.1}, {0.63, 0.93}), line({-0.1, 0.8}, {0.3, 1.1})}) {
      ASSERT_EQ(body.cut(curve, method), Status::ok);
      const SystemMatrix<2> a = body.model.system();
      std::vector<std::int32_t> changed;
      RowChanges changes;
      fine.resize(a.vertices());
      std::set<std::int32_t> marked;
      if (n > 0) {
        const auto since = a.history->changed_since(seen);
        marked.insert(since.begin(), since.end());
      }
      for (std::size_t i = 0; i < a.vertices(); ++i) {
        if (i < n && !marked.contains(static_cast<std::int32_t>(i))) continue;
        changed.push_back(static_cast<std::int32_t>(i));
        const bool moves = i < n && length((*a.places)[i] - places[i]) > 0;
        if (fine.blocks.set(i, a.blocks->columns(i)).is_new || moves)
          changes.links.push_back(static_cast<std::int32_t>(i));
        if (fine.set_scalars(i, a.blocks->columns(i), std::vector<double>(a.blocks->columns(i).size(), value)))
          changes.rows.push_back(static_cast<std::int32_t>(i));
      }
      EXPECT_TRUE(n == 0 || 2 * changed.size() < n);
      ++value, n = a.vertices(), seen = a.pattern, places = *a.places;
      // Groups that come and go.
      Coarsening::Regrouping regrouping{changed, {}};
      for (std::size_t k = 2; k < changed.size(); k += 17) regrouping.groups.push_back({changed[k - 2], changed[k]});
      first.update(fine, *a.places, changes, regrouping), first.multiply(fine, coarse);
      second.update(coarse, first.coarse_places(), first.changes()), second.multiply(coarse, coarsest);
      EXPECT_TRUE(changed.size() == n || 2 * first.changes().rows.size() < first.coarse_size());

      Coarsening::Regrouping groups;
      for (std::size_t k = 0; k < first.coarse_size(); ++k)
        if (const auto members = first.members(k);
            !members.empty() &&
            first.group_of(static_cast<std::size_t>(members[0].other)) == static_cast<std::int32_t>(k))
          groups.groups.push_back({members[0].other, members[1].other});
      Coarsening first_anew(spacing), second_anew(2 * spacing);
      LevelRows coarse_anew, coarsest_anew;
      first_anew.update(fine, *a.places, all_of(fine), groups), first_anew.multiply(fine, coarse_anew);
      second_anew.update(coarse_anew, first_anew.coarse_places(), all_of(coarse_anew));
      second_anew.multiply(coarse_anew, coarsest_anew);
      const auto all = product_of(first, coarse), anew = product_of(first_anew, coarse_anew);
      ASSERT_EQ(all.size(), anew.size());
      for (const auto& [part, row] : anew) {
        const auto there = all.find(part);
        ASSERT_TRUE(there != all.end());
        ASSERT_EQ(there->second.size(), row.size());
        for (const auto& [other, sum] : row) ASSERT_NEAR(there->second.at(other), sum, 1e-9);
      }
      // Numbers of coarse unknowns differ: the next level is compared by what it does to a constant and a sum.
      std::multiset<std::size_t> sizes, sizes_anew;
      double total = 0, total_anew = 0;
      for (std::size_t i = 0; i < coarsest.size(); ++i)
        if (!second.members(i).empty()) sizes.insert(coarsest.scalars[i].size());
      for (std::size_t i = 0; i < coarsest_anew.size(); ++i)
        if (!second_anew.members(i).empty()) sizes_anew.insert(coarsest_anew.scalars[i].size());
      for (std::size_t i = 0; i < coarsest.size(); ++i)
        for (std::size_t k = 0; k < coarsest.scalars[i].size(); ++k)
          total += coarsest.scalar[coarsest.scalars.first_slot(i) + k];
      for (std::size_t i = 0; i < coarsest_anew.size(); ++i)
        for (std::size_t k = 0; k < coarsest_anew.scalars[i].size(); ++k)
          total_anew += coarsest_anew.scalar[coarsest_anew.scalars.first_slot(i) + k];
      EXPECT_EQ(sizes, sizes_anew);
      EXPECT_NEAR(total, total_anew, 1e-6 * total_anew);
    }
  }
}

// --- stiff clusters --------------------------------------------------------------------------------------------------

/// The corrections are those of dense solves, one cluster after the other, and the residual that is kept is the true one.
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

  const auto n = static_cast<Eigen::Index>(2 * a.vertices());
  const Eigen::MatrixXd all = matrix.dense();
  const Field right = random_field(9, n);
  std::vector<double> r(static_cast<std::size_t>(n) + 4), z(r.size()), t(r.size());
  Eigen::Map<Field>(r.data(), n) = right, t = r;
  clusters.correct_forwards(matrix, z, t);
  const Field forwards = Eigen::Map<const Field>(z.data(), n);
  EXPECT_LT((Eigen::Map<const Field>(t.data(), n) - (right - all * forwards)).norm(), 1e-9 * right.norm());
  // Each correction is the best in its space, so the energy that is left falls by half of r.z in the end.
  EXPECT_GT(right.dot(forwards), 0);
  EXPECT_LT(forwards.dot(all * forwards) / 2 - right.dot(forwards), 0);
  // Backwards after forwards is symmetric: B = B^T for the residuals r and q.
  const auto both = [&](const Field& from) {
    std::vector<double> x(r.size()), left(r.size()), start(r.size());
    Eigen::Map<Field>(left.data(), n) = from, start = left;
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

// --- the cycle -------------------------------------------------------------------------------------------------------

template <int D>
Eigen::DiagonalMatrix<double, Eigen::Dynamic> held_as_identity(const SystemMatrix<D>& a) {
  Field one(static_cast<Eigen::Index>(a.held->size()));
  for (Eigen::Index u = 0; u < one.size(); ++u) one[u] = (*a.held)[static_cast<std::size_t>(u)];
  return one.asDiagonal();
}

template <int D>
void expect_good_preconditioner(const std::string& family, BendingKind bending, const std::string& method) {
  SCOPED_TRACE(family + ", " + method);
  const Body<D> body = cut_body<D>(family, 14, bending, method);
  const SystemMatrix<D> a = body.model.system();
  Multigrid<D> multigrid;
  multigrid.setup(a);
  EXPECT_GT(multigrid.levels(), 1u);
  // Residuals of all kinds: any, of errors that are stiff, and of errors that are soft.
  const Eigen::MatrixXd matrix = dense(a) + Eigen::MatrixXd(held_as_identity(a));
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  std::vector<Field> residuals;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Field any = random_field(seed, matrix.rows());
    for (const Field& r : {any, Field(matrix * any), Field(factor.solve(any))})
      residuals.push_back(r.normalized()), project(*a.held, Field(residuals.back()), residuals.back());
  }
  std::vector<Field> corrections;
  for (const Field& r : residuals) {
    corrections.push_back(Field::Zero(r.size()));
    multigrid.apply(r, corrections.back());
    for (Eigen::Index u = 0; u < r.size(); ++u)
      if ((*a.held)[static_cast<std::size_t>(u)]) {
        ASSERT_EQ(corrections.back()[u], 0);
      }
    // Its energy is at most that of the exact correction: symmetric Gauss-Seidel and exact projections never overshoot.
    EXPECT_GT(r.dot(corrections.back()), 0);
    EXPECT_LT(r.dot(corrections.back()), 1.001 * r.dot(factor.solve(r)));
  }
  for (std::size_t i = 0; i < residuals.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double scale = std::sqrt(residuals[i].dot(corrections[i]) * residuals[k].dot(corrections[k]));
      EXPECT_NEAR(residuals[i].dot(corrections[k]), residuals[k].dot(corrections[i]), 1e-3 * scale);
    }
}

TEST(Multigrid, IsSymmetricAndPositiveDefinite) {
  for (const std::string family : {"grid", "delaunay", "graded", "alternating"})
    for (const std::string method : {"conventional_split", "warp_and_refine"}) {
      expect_good_preconditioner<2>(family, BendingKind::none, method);
      expect_good_preconditioner<3>(family, BendingKind::patches, method);
    }
  expect_good_preconditioner<3>("delaunay", BendingKind::hinges, "bowyer_watson");
}

/// Without places there are no levels, only the sweeps.
TEST(Multigrid, WithoutPlaces) {
  const Body<2> body = cut_body<2>("grid", 10, BendingKind::none, "conventional_split");
  SystemMatrix<2> a = body.model.system();
  a.places = nullptr;
  Multigrid<2> multigrid;
  multigrid.setup(a);
  EXPECT_EQ(multigrid.levels(), 1u);
  const auto solver = make_solver<2>({.name = "multigrid", .tolerance = 1e-10});
  solver->setup(a);
  Field x;
  const Field b = random_field(5, static_cast<Eigen::Index>(2 * a.vertices()));
  EXPECT_TRUE(solver->solve(b, x).converged);
}

template <int D>
int iterations(const Body<D>& body, const std::string& name, double tolerance) {
  const auto solver = make_solver<D>({.name = name, .tolerance = tolerance});
  const SystemMatrix<D> a = body.model.system();
  solver->setup(a);
  Field x;
  const SolveReport report = solver->solve(random_field(6, static_cast<Eigen::Index>(D * body.model.vertices())), x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(report.fell_back);
  return report.iterations;
}

/// The iterations hardly grow with the number of triangles, where those of the diagonal blocks do.
TEST(Multigrid, IterationsDoNotFollowTheResolution) {
  for (const std::string family : {"grid", "delaunay"}) {
    SCOPED_TRACE(family);
    std::vector<int> multigrid, diagonal;
    for (const int n : {10, 40}) {
      const Body<2> body = cut_body<2>(family, n, BendingKind::none, "conventional_split");
      multigrid.push_back(iterations(body, "multigrid", 1e-6)), diagonal.push_back(iterations(body, "cg", 1e-6));
    }
    EXPECT_LE(multigrid[1], 30);
    EXPECT_LE(multigrid[1], 2 * multigrid[0]);
    EXPECT_GE(diagonal[1], 3 * diagonal[0] / 2);
    EXPECT_LE(4 * multigrid[1], diagonal[1]);
  }
}

/// The same hierarchy object through cuts: as good as a new one, and the solution is that of the direct solver.
TEST(Multigrid, FollowsTheCuts) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "delaunay_refine", "bowyer_watson"}) {
    SCOPED_TRACE(method);
    Body<3> body(make_sheet("delaunay", 12), skin, {.bending = BendingKind::patches}, held_left());
    const auto kept = make_solver<3>({.name = "multigrid", .tolerance = 1e-10});
    for (const Curve& curve : {line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                               polygon({{0.22, 0.63}, {0.41, 0.64}, {0.33, 0.81}})}) {
      ASSERT_EQ(body.cut(curve, method), Status::ok);
      body.model.rotate(bent(body.model, body.sheet));
      body.model.assemble(1, 1e-4);
      const Field b = random_field(7, static_cast<Eigen::Index>(3 * body.model.vertices()));
      Field x, fresh, exact;
      const SystemMatrix<3> a = body.model.system();
      kept->setup(a);
      const SolveReport report = kept->solve(b, x);
      EXPECT_TRUE(report.converged);
      EXPECT_FALSE(report.fell_back);
      const auto other = make_solver<3>({.name = "multigrid", .tolerance = 1e-10});
      other->setup(a);
      const SolveReport anew = other->solve(b, fresh);
      EXPECT_LE(report.iterations, anew.iterations + 2);
      EXPECT_LT((x - fresh).norm(), 1e-7 * fresh.norm());
      const auto direct = make_solver<3>({.name = "cholmod"});
      direct->setup(a);
      direct->solve(b, exact);
      EXPECT_LT((x - exact).norm(), 1e-6 * exact.norm());
    }
  }
}

/// A needle so thin that floats cannot hold its stiffness beside the sheet's.
TEST(Multigrid, ExtremeSlivers) {
  for (const double distance : {1e-4, 1e-7, 1e-10}) {
    SCOPED_TRACE(distance);
    Body<3> body(make_sheet("grid", 16), skin, {.bending = BendingKind::patches}, held_left());
    ASSERT_EQ(body.cut(line({0.1, 0.5 + distance}, {0.9, 0.5 + 2 * distance})), Status::ok);
    body.model.rotate(body.model.positions(body.sheet));
    body.model.assemble(1, 1e-4);
    const auto solver = make_solver<3>({.name = "multigrid", .tolerance = 1e-2});
    const SystemMatrix<3> a = body.model.system();
    solver->setup(a);
    Field x;
    Field b = Field::Zero(static_cast<Eigen::Index>(3 * body.model.vertices()));
    body.model.add_external_force(b);
    b += random_field(8, b.size());
    const SolveReport report = solver->solve(b, x);
    EXPECT_TRUE(x.allFinite());
    const auto plain = make_solver<3>({.name = "cg", .tolerance = 1e-2});
    plain->setup(a);
    Field y;
    const bool can_be_solved = plain->solve(b, y).converged;  // in doubles, by any iteration
    EXPECT_TRUE(report.converged || (distance < 1e-9 && !can_be_solved))
        << report.iterations << " iterations, residual " << report.residual;
  }
}

/// A state that is not finite makes matrices of NaN. The solver says that it has not converged, and comes back.
TEST(Multigrid, NotFinite) {
  for (const std::size_t every : {1, 2, 3, 7}) {
    Body<3> body = cut_body<3>("delaunay", 14, BendingKind::patches, "conventional_split");
    Field x = body.model.positions(body.sheet);
    for (Eigen::Index u = 0; u < x.size(); u += static_cast<Eigen::Index>(3 * every))
      x[u] = std::numeric_limits<double>::quiet_NaN();
    body.model.rotate(x);
    body.model.assemble(1, 1e-4);
    const SystemMatrix<3> a = body.model.system();
    const auto solver = make_solver<3>({.name = "multigrid", .tolerance = 1e-2, .max_iterations = 50});
    solver->setup(a);
    Field y;
    EXPECT_FALSE(solver->solve(random_field(3, x.size()), y).converged);
  }
}

/// The first step after cuts drawn as those of the robustness campaign. CUTBENCH_TEST_SCALE=200 makes 99,200 solves.
TEST(Multigrid, AdversarialCuts) {
  constexpr std::uint64_t seed = 99173;
  std::size_t solves = 0, unsolved = 0, fallbacks = 0, iterations = 0;
  const auto solve = [&](const SystemMatrix<3>& a, const Field& b, const std::string& name, int most) {
    const auto solver = make_solver<3>({.name = name, .tolerance = 1e-2, .max_iterations = most});
    solver->setup(a);
    Field x;
    const SolveReport report = solver->solve(b, x);
    EXPECT_TRUE(x.allFinite() || !b.allFinite() || !report.converged);
    return report;
  };
  for (const std::string family : {"grid", "delaunay", "graded", "alternating"})
    for (const int n : {6, 20}) {
      const MeshData mesh = make_sheet(family, n);
      for (std::size_t i = 0; i < scaled(2); ++i)
        for (const MethodRow& row : all_methods()) {
          SCOPED_TRACE(family + ", n " + std::to_string(n) + ", case " + std::to_string(i) + ", " + row.name);
          Body<3> body(mesh, skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}}, held_left());
          const auto method = row.make(row.knob.value);
          if (method->why_unsupported(body.sheet)) continue;
          for (const Curve& curve : make_mixture_case(seed, i, Sheet(mesh)).cuts)
            body.cut(curve, row.name, row.knob.value);
          Field x = body.model.positions(body.sheet);
          x += 0.01 / n * random_field(i + 1, x.size());
          body.model.rotate(x);
          Field b = Field::Zero(x.size());
          body.model.add_internal_force(x, b);
          body.model.add_external_force(b);
          for (const double step : {1.0 / 240, 1.0 / 60}) {
            body.model.assemble(1, step * step + 1e-3 * step);
            const SystemMatrix<3> a = body.model.system();
            const SolveReport report = solve(a, b, "multigrid", 20000);
            ++solves, fallbacks += report.fell_back, iterations += static_cast<std::size_t>(report.iterations);
            if (report.converged) continue;
            ++unsolved;
            EXPECT_FALSE(solve(a, b, "cg", 20000).converged);
          }
        }
    }
  std::printf("%zu solves, %.2f iterations in the mean, %zu fall-backs; %zu not solved, nor by cg\n", solves,
              static_cast<double>(iterations) / static_cast<double>(solves), fallbacks, unsolved);
  EXPECT_LT(100 * unsolved, solves);
}

}  // namespace
}  // namespace cutbench
