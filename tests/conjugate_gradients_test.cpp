// Conjugate gradients whose first preconditioner gives up: who takes its place, and when the first is tried again.
#include "harness/fem/linear/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <limits>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/solvers/factor_preconditioners.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

/// Counts its set-ups; z = share r, so it is as slow as no preconditioner, and with a share of NaN worse.
class Poor final : public Preconditioner<3> {
 public:
  using Preconditioner<3>::setup;
  Poor(int& setups, const double& share) : setups_(setups), share_(share) {}
  void setup(const SystemMatrix<3>&) override { ++setups_; }
  void apply(const Field& r, Field& z) override { z = share_ * r; }

 private:
  int& setups_;
  const double& share_;
};

class GivesUp : public testing::Test {
 protected:
  GivesUp() : body_(make_sheet("grid", 10), skin, {.bending = BendingKind::patches}, held_left()) {
    body_.cut(line({-0.1, 0.313}, {1.1, 0.741}));
    body_.model.rotate(bent(body_.model, body_.sheet));
    body_.model.assemble(1, 1e-3);
    matrix_ = body_.model.system();
    Random random(3);
    right_.resize(to_index(3 * matrix_.vertices()));
    for (double& value : right_) value = random.between(-1, 1);
  }
  static std::vector<Pin> held_left() {
    Pin pin;
    pin.where = {{-1, -1}, {1e-9, 2}};
    return {pin};
  }
  /// A poor one for 5 iterations, then an exact factor, if wanted.
  ConjugateGradients<3> solver(bool factor = true) {
    std::vector<ConjugateGradients<3>::Trial> trials;
    trials.push_back({.preconditioner = std::make_unique<Poor>(setups_, share_), .most_iterations = 5});
    if (factor) trials.push_back({.preconditioner = std::make_unique<StaleFactor<3>>()});
    return {{.tolerance = 1e-8}, std::move(trials)};
  }
  double residual(const Field& x) const {
    Field b, ax;
    project(*matrix_.held, right_, b);
    matrix_.multiply(x, ax);
    return (b - ax).norm() / b.norm();
  }

  Body<3> body_;
  SystemMatrix<3> matrix_;
  Field right_;
  int setups_ = 0;
  double share_ = 1;
};

TEST_F(GivesUp, TheNextTakesItsPlace) {
  auto cg = solver();
  cg.setup(matrix_);
  Field x;
  const SolveReport report = cg.solve(right_, x, Field());
  EXPECT_TRUE(report.converged && report.fell_back);
  EXPECT_LE(report.iterations, 5 + 2);
  EXPECT_LE(residual(x), 1e-8);
  const SolveReport again = cg.solve(right_, x, Field());
  EXPECT_TRUE(again.converged && again.fell_back);
  EXPECT_LE(again.iterations, 2);  // the poor one is not asked again
}

TEST_F(GivesUp, ItIsTriedAgainEverMoreSeldom) {
  auto cg = solver();
  Field x;
  std::vector<int> tried;
  for (int i = 0; i < 1 + 2 + 4 + 8 + 16 + 32; ++i) {
    const int before = setups_;
    cg.setup(matrix_);
    EXPECT_TRUE(cg.solve(right_, x, Field()).converged);
    if (setups_ > before) tried.push_back(i);
  }
  EXPECT_EQ(tried, (std::vector<int>{0, 1, 1 + 2, 3 + 4, 7 + 8, 15 + 16}));
}

/// One that works again costs no more than the solve that it failed in.
TEST_F(GivesUp, ItIsTriedWithTheNextMatrix) {
  auto cg = solver();
  Field x;
  for (const bool works : {false, true, false}) {
    share_ = works ? 1 : std::numeric_limits<double>::quiet_NaN();
    cg.setup(matrix_);
    const Field start = works ? x : Field();  // a solution already
    const SolveReport report = cg.solve(right_, x, start);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.fell_back, !works);
  }
  EXPECT_EQ(setups_, 3);
}

TEST_F(GivesUp, NoNumber) {
  share_ = std::numeric_limits<double>::quiet_NaN();
  auto cg = solver();
  cg.setup(matrix_);
  Field x;
  const SolveReport report = cg.solve(right_, x, Field());
  EXPECT_TRUE(report.converged && report.fell_back);
  EXPECT_LE(residual(x), 1e-8);
}

TEST_F(GivesUp, TheDiagonalBlocksAreTheLast) {
  auto cg = solver(false);
  cg.setup(matrix_);
  Field x;
  const SolveReport report = cg.solve(right_, x, Field());
  EXPECT_TRUE(report.converged && report.fell_back);
  EXPECT_GT(report.iterations, 5);
  EXPECT_LE(residual(x), 1e-8);
}

TEST_F(GivesUp, WhatItMayNotSpendIsNotSpent) {
  std::vector<ConjugateGradients<3>::Trial> trials;
  trials.push_back({.preconditioner = std::make_unique<Poor>(setups_, share_), .most_iterations = 5});
  ConjugateGradients<3> cg({.tolerance = 1e-8, .max_iterations = 8}, std::move(trials));
  cg.setup(matrix_);
  Field x;
  const SolveReport report = cg.solve(right_, x, Field());
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 8);
}

}  // namespace
}  // namespace cutbench
