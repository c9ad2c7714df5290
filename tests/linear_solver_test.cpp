// Every solver against dense matrices: what it reaches, that it says when it did not, and that it follows the matrix.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/base/random.h"
#include "harness/fem/linear/factor.h"
#include "harness/fem/solvers/solver_table.h"
#include "tests/linear_systems.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two scalar terms, of which one reaches further than the blocks; a tenth of the unknowns held; one vertex freed.
template <int D>
System<D> random_system(std::uint64_t seed, int side = 6) {
  Random random(seed);
  System<D> s;
  s.blocks = random_matrix(random, side, 1, D);
  s.scalar.push_back({0.3, random_matrix(random, side, 2, 1)});
  s.scalar.push_back({2, random_matrix(random, side, 1, 1)});
  s.held.resize(to_size(s.blocks.rows()));
  for (auto& held : s.held) held = random.coin(0.1);
  const Eigen::Index freed = s.vertices() / 2;
  s.blocks.middleRows(D * freed, D).setZero();
  s.blocks.middleCols(D * freed, D).setZero();
  for (auto& term : s.scalar) {
    term.matrix.row(freed).setZero();
    term.matrix.col(freed).setZero();
  }
  for (Eigen::Index k = 0; k < D; ++k) s.held[to_size(D * freed + k)] = 1;
  return s;
}

bool is_direct(const std::string& name) {
  return name == "cholmod" || name == "cholmod_same_order" || name == "eigen_ldlt";
}

bool keeps_old_factors(const std::string& name) { return name == "cholmod_stale" || name == "cholmod_same_order"; }

template <class Dimension>
struct LinearSolvers : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LinearSolvers, Dimensions, );

TYPED_TEST(LinearSolvers, AgreeWithDenseCholesky) {
  constexpr int dimension = TypeParam::value;
  for (SolverOptions options : all_solvers())
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(options.name + ", seed " + std::to_string(seed));
      options.tolerance = 1e-11;
      options.max_iterations = 1000;
      const System<dimension> system = random_system<dimension>(seed);
      const Field b = 1e3 * random_field(seed + 100, system.blocks.rows());  // held entries too, which must not matter
      const auto s = solved<dimension>(options, system, b);
      const Field exact = system.oracle(b);
      EXPECT_TRUE(s.report.converged);
      EXPECT_LT((s.x - exact).norm(), 1e-9 * exact.norm());
      EXPECT_NEAR(s.report.residual, system.residual(b, s.x), 1e-14);
      EXPECT_LE(s.report.residual, 1e-11);
      if (options.name != "multigrid") {  // which solves small free pieces directly
        EXPECT_EQ(s.report.iterations == 0, is_direct(options.name));
      }
      for (Eigen::Index u = 0; u < s.x.size(); ++u) EXPECT_TRUE(!system.is_held(u) || s.x[u] == 0);
    }
}

TYPED_TEST(LinearSolvers, StopAtTheTolerance) {
  constexpr int dimension = TypeParam::value;
  const System<dimension> system = random_system<dimension>(7, 10);
  const Field b = random_field(8, system.blocks.rows());
  int before = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    const auto s = solved<dimension>({.name = "cg", .tolerance = tolerance, .max_iterations = 1000}, system, b);
    EXPECT_TRUE(s.report.converged);
    EXPECT_LE(s.report.residual, tolerance);
    EXPECT_GT(s.report.residual, tolerance / 100);
    EXPECT_GT(s.report.iterations, before);
    EXPECT_NEAR(s.report.residual, system.residual(b, s.x), 1e-14);
    before = s.report.iterations;
  }
}

TYPED_TEST(LinearSolvers, NothingToSolve) {
  constexpr int dimension = TypeParam::value;
  const System<dimension> system = random_system<dimension>(9);
  Field b(system.blocks.rows());
  for (Eigen::Index u = 0; u < b.size(); ++u) b[u] = system.is_held(u) ? 17 : 0;
  for (const SolverOptions& options : all_solvers())
    for (const Field& right : {b, Field(Field::Zero(b.size()))}) {
      const auto s = solved<dimension>(options, system, right);
      EXPECT_TRUE(s.report.converged) << options.name;
      EXPECT_EQ(s.report.residual, 0) << options.name;
      EXPECT_EQ(s.x, Field::Zero(b.size())) << options.name;
    }
}

TYPED_TEST(LinearSolvers, SayWhenTheyDidNotConverge) {
  constexpr int dimension = TypeParam::value;
  constexpr Eigen::Index free = 2 * dimension;  // the first unknown of two vertices that we see to it are not held
  System<dimension> good = random_system<dimension>(11);
  std::fill(good.held.begin() + free, good.held.begin() + free + 2 * dimension, std::uint8_t{0});
  const Field b = random_field(12, good.blocks.rows());
  const auto expect_failure = [&](const std::string& what, const System<dimension>& system, const Field& right) {
    for (SolverOptions options : all_solvers()) {
      const std::string& name = options.name;
      options.tolerance = 1e-8;
      options.max_iterations = 1000;
      if (name == "eigen_cg" && what == "indefinite beside the diagonal") continue;  // it does not look, and solves it
      const auto s = solved<dimension>(options, system, right);
      EXPECT_FALSE(s.report.converged) << name << ", " << what;
      EXPECT_FALSE(s.report.residual <= 1e-8) << name << ", " << what;
      EXPECT_EQ(s.x.size(), right.size());
    }
  };
  System<dimension> bad = good;
  bad.blocks(free, free) = nan;
  expect_failure("NaN on the diagonal", bad, b);
  bad.blocks(free, free) = std::numeric_limits<double>::infinity();
  expect_failure("infinity on the diagonal", bad, b);
  bad = good;
  bad.blocks(free, free) -= 1000;
  expect_failure("indefinite on the diagonal", bad, b);
  for (const Eigen::Index other : {free + 1, free + dimension}) {
    bad = good;
    bad.blocks(free, other) = bad.blocks(other, free) = 1000;
    expect_failure("indefinite beside the diagonal", bad, b);
  }
  bad = good;
  bad.blocks *= -1;
  for (auto& term : bad.scalar) term.factor *= -1;
  expect_failure("negative definite", bad, b);
  bad = good;
  bad.blocks.setZero();
  bad.scalar.clear();
  expect_failure("zero", bad, b);
  // A vertex that nothing holds and nothing is said of, though its row is empty.
  bad = good;
  std::fill(bad.held.begin(), bad.held.end(), std::uint8_t{0});
  expect_failure("empty row, not held", bad, b);
  Field wrong = b;
  wrong[free] = nan;
  expect_failure("NaN on the right", good, wrong);
}

TYPED_TEST(LinearSolvers, FollowTheMatrix) {
  constexpr int dimension = TypeParam::value;
  for (SolverOptions options : all_solvers()) {
    SCOPED_TRACE(options.name);
    options.tolerance = 1e-11;
    options.max_iterations = 1000;
    const auto solver = make_solver<dimension>(options);
    System<dimension> system = random_system<dimension>(21);
    Sparse<dimension> sparse(system);
    const auto expect_same_as_new = [&](const std::string& what) {
      const Field b = random_field(22, system.blocks.rows());
      const auto s = solved(*solver, sparse.matrix(), b), fresh = solved<dimension>(options, system, b);
      const Field exact = system.oracle(b);
      EXPECT_TRUE(s.report.converged) << what;
      EXPECT_LT((s.x - exact).norm(), 1e-9 * exact.norm()) << what;
      if (!keeps_old_factors(options.name)) {
        EXPECT_EQ(s.x, fresh.x) << what;  // bit by bit
      }
    };
    expect_same_as_new("first");
    system.blocks *= 3;
    system.scalar[0].factor = 0.7;
    sparse.assign(system);
    expect_same_as_new("other values");
    std::fill(system.held.begin(), system.held.begin() + dimension, std::uint8_t{1});
    sparse.assign(system);
    expect_same_as_new("other held unknowns");

    Eigen::MatrixXd& a = system.blocks;  // a new connection, far away
    const Eigen::Index last = a.rows() - 1, before = last - 2 * dimension;
    a(2 * dimension, last) = a(last, 2 * dimension) = 0.05;
    a(3 * dimension, before) = a(before, 3 * dimension) = -0.05;
    sparse.assign(system);
    ++sparse.matrix().pattern;
    expect_same_as_new("another pattern");
    system = random_system<dimension>(23, 7);
    sparse.assign(system);
    ++sparse.matrix().pattern;
    expect_same_as_new("another size");

    // A matrix that can't be solved leaves nothing behind.
    const System<dimension> good = system;
    system.blocks *= -1;
    sparse.assign(system);
    EXPECT_FALSE(solved(*solver, sparse.matrix(), random_field(22, system.blocks.rows())).report.converged);
    system = good;
    sparse.assign(system);
    expect_same_as_new("after a failure");
  }
}

TYPED_TEST(LinearSolvers, AreDeterministic) {
  constexpr int dimension = TypeParam::value;
  const System<dimension> system = random_system<dimension>(31, 9);
  Sparse<dimension> sparse(system);
  const Field b = random_field(32, system.blocks.rows()), other = random_field(33, b.size());
  for (SolverOptions options : all_solvers()) {
    const std::string& name = options.name;
    options.tolerance = 1e-6;
    const auto solver = make_solver<dimension>(options);
    const auto first = solved(*solver, sparse.matrix(), b);
    solved(*solver, sparse.matrix(), other);
    Field x = Field::Constant(3, nan);  // what x holds before must not matter
    const SolveReport report = solver->solve(b, x);
    EXPECT_EQ(x, first.x) << name;
    EXPECT_EQ(report.residual, first.report.residual) << name;
    EXPECT_EQ(report.iterations, first.report.iterations) << name;
  }
}

/// Both factors, kept through a change of values and of the pattern, against each other.
TYPED_TEST(LinearSolvers, FactorsAgree) {
  constexpr int dimension = TypeParam::value;
  const auto factor = make_factor<dimension>(FactorBy::fastest), plain = make_factor<dimension>(FactorBy::eigen);
  for (const std::uint64_t seed : {41, 42}) {
    System<dimension> system = random_system<dimension>(seed, 6 + to_int(seed % 2));
    Sparse<dimension> sparse(system);
    sparse.matrix().pattern = seed;
    for (const double times : {1.0, 3.0}) {
      system.blocks *= times;
      sparse.assign(system);
      for (Factor<dimension>* each : {factor.get(), plain.get()}) {
        EXPECT_EQ(each->is_new(sparse.matrix()), times == 1);
        ASSERT_TRUE(each->factor(sparse.matrix()));
        EXPECT_EQ(each->largest_entry(), system.dense().cwiseAbs().maxCoeff());
      }
      const Eigen::MatrixXd b = random_field(seed, 2 * system.blocks.rows()).reshaped(system.blocks.rows(), 2);
      Eigen::MatrixXd x, y;
      ASSERT_TRUE(factor->solve(b, x) && plain->solve(b, y));
      EXPECT_LT((x - y).norm(), 1e-11 * x.norm());
      for (Eigen::Index u = 0; u < y.rows(); ++u) EXPECT_TRUE(!system.is_held(u) || y.row(u).isZero(0));
    }
  }
}

/// A build without CHOLMOD says so where one of its solvers is named.
TEST(LinearSolver, CholmodIsNamedWhereItIsThere) {
  for (const std::string name : {"cholmod", "cholmod_same_order", "cholmod_stale"}) {
    const auto& names = solver_names();
    EXPECT_EQ(std::find(names.begin(), names.end(), name) != names.end(), has_cholmod());
    EXPECT_EQ(solver_help().find("  " + name + " ") != std::string::npos, has_cholmod());
    std::string refusal;
    try {
      make_solver<2>({.name = name});
    } catch (const InputError& error) {
      refusal = error.what();
    }
    EXPECT_EQ(refusal.find("needs CHOLMOD") != std::string::npos, !has_cholmod()) << refusal;
  }
}

TEST(LinearSolver, UnknownName) {
  try {
    make_solver<3>({.name = "gmres"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "solver \"gmres\" is not known; known are " + listed(nearest_first("gmres", solver_names())));
  }
}

}  // namespace
}  // namespace cutbench
