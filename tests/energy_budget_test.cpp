// The energy budget closes: what is not accounted for is zero where it must be, and shrinks where it may.
#include "harness/scene/energy_budget.h"

#include <gtest/gtest.h>

#include "harness/fem/stepper.h"
#include "harness/mesh/families.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

constexpr Material skin{.density = 2.2,
                        .stiffness = 1000,
                        .poisson = 0.45,
                        .bending = 4.2e-4,
                        .mass_damping = 0.5,
                        .stiffness_damping = 1e-3};

StepOptions steps_of(double step, int newton = 1) {
  return {.step = step, .newton = newton, .solver = {.name = "cholmod", .tolerance = 1e-10}};
}

EnergyBudget run(Body<3>& body, double step, int steps, int newton = 1) {
  Stepper<3> stepper(steps_of(step, newton));
  EnergyBudget budget(balance_of(body.model, body.state));
  for (int n = 0; n < steps; ++n) {
    if (n == steps / 2) {
      const Balance before = balance_of(body.model, body.state);
      EXPECT_EQ(body.cut(line({0.31, 0.2}, {0.48, 0.83})), Status::ok);
      budget.add_cut(before, balance_of(body.model, body.state));
    }
    const State before = body.state;
    EXPECT_EQ(stepper.step(body.model, body.state).verdict, "ok");
    budget.add_step(body.model, before, body.state, step);
  }
  return budget;
}

/// Pulled, shaken, cut and damped: every term is at work, and a wrong one would leave a remainder.
TEST(EnergyBudget, OfALinearSheetClosesToRounding) {
  for (const Mass mass : {Mass::lumped, Mass::consistent}) {
    Body<3> body(make_sheet("delaunay", 8), skin,
                 {.strain = Strain::linear, .bending = BendingKind::patches, .mass = mass, .gravity = {0, 0, -9.81}},
                 {{.where = {{0, 0}, {0, 1}}},
                  {.where = {{1, 0}, {1, 1}}, .displacement = {0.05, 0, 0.1}, .velocity = {0.2, -0.1, 0.4}}},
                 {{.where = {{0, 1}, {1, 1}}, .force = {0, 3, 1}}});
    const BudgetRow end = run(body, 1.0 / 120, 40).rows().back();
    EXPECT_GT(end.damping, 0.01);
    EXPECT_GT(end.numerical_loss, 0.01);
    EXPECT_GT(std::abs(end.pin_work), 0.01);
    EXPECT_GT(end.energy.kinetic, 0.01);
    EXPECT_NE(end.jumps, 0);  // bending, at the least
    EXPECT_NEAR(end.remainder, 0, 1e-11 * (end.damping + end.numerical_loss));
  }
}

/// One linearisation per step is off by a power of the step; a second nearly removes it.
TEST(EnergyBudget, TheRemainderIsTheErrorOfTheLinearisation) {
  std::vector<double> remainder;
  for (const auto& [step, newton] : {std::pair{1.0 / 60, 1}, {1.0 / 240, 1}, {1.0 / 60, 3}}) {
    Body<3> body(make_sheet("alternating", 8), skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}},
                 {{.where = {{0, 0}, {0, 1}}}});
    remainder.push_back(std::abs(run(body, step, static_cast<int>(0.4 / step + 0.5), newton).rows().back().remainder));
  }
  EXPECT_GT(remainder[0], 1e-6);
  EXPECT_LT(remainder[1], remainder[0] / 2);
}

TEST(EnergyBudget, GrowthIsWhatNothingExplains) {
  Balance first, more;
  first.energy.membrane = 10, more.energy.membrane = 13;
  EnergyBudget budget(first);
  EXPECT_EQ(budget.growth(), 0);
  budget.add_cut(first, more);  // a jump explains it
  EXPECT_EQ(budget.growth(), 0);
  // An explicit push: a free vertex's velocity made larger between two steps is energy out of nowhere.
  Body<3> body(make_sheet("grid", 4), skin, {.gravity = {0, 0, -9.81}}, {{.where = {{0, 0}, {0, 1}}}});
  Stepper<3> stepper(steps_of(0.01));
  EnergyBudget pushed(balance_of(body.model, body.state));
  for (int n = 0; n < 10; ++n) {
    const State before = body.state;
    ASSERT_EQ(stepper.step(body.model, body.state).verdict, "ok");
    pushed.add_step(body.model, before, body.state, 0.01);
  }
  EXPECT_LT(pushed.growth(), 0.01);
  body.state.v *= 3;
  const State before = body.state;
  ASSERT_EQ(stepper.step(body.model, body.state).verdict, "ok");
  pushed.add_step(body.model, before, body.state, 0.01);
  EXPECT_GT(pushed.growth(), 0.1);
}

}  // namespace
}  // namespace cutbench
