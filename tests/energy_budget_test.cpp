// The energy budget closes: what is not accounted for is zero where it must be, and shrinks where it may.
#include "harness/simulation/energy_budget.h"

#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "harness/fem/time/stepper.h"
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

StepOptions steps_of(double step, int newton = 1, Integrator integrator = Integrator::backward_euler) {
  return {.integrator = integrator, .step = step, .newton = newton, .solver = {.name = "cholmod", .tolerance = 1e-10}};
}

EnergyBudget run(Body<3>& body, double step, int steps, int newton = 1,
                 Integrator integrator = Integrator::backward_euler) {
  Stepper<3> stepper(steps_of(step, newton, integrator));
  EnergyBudget budget(balance_of(body.model, body.state), integrator);
  for (int n = 0; n < steps; ++n) {
    if (n == steps / 2) {
      const Balance before = balance_of(body.model, body.state);
      EXPECT_EQ(body.cut(line({0.31, 0.2}, {0.48, 0.83})), Status::ok);
      budget.add_cut(before, balance_of(body.model, body.state));
    }
    const State before = body.state;
    EXPECT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
    budget.add_step(body.model, before, body.state, step);
  }
  return budget;
}

/// Pulled, shaken, cut and damped: every term is at work, and a wrong one would leave a remainder.
Body<3> shaken(Mass mass, const Material& material) {
  return {make_sheet("delaunay", 8),
          material,
          {.strain = Strain::linear, .bending = BendingKind::patches, .mass = mass, .gravity = {0, 0, -9.81}},
          {{.where = {{0, 0}, {0, 1}}},
           {.where = {{1, 0}, {1, 1}}, .displacement = {0.05, 0, 0.1}, .velocity = {0.2, -0.1, 0.4}}},
          {{.where = {{0, 1}, {1, 1}}, .force = {0, 3, 1}}}};
}

TEST(EnergyBudget, OfALinearSheetClosesToRounding) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint})
    for (const Mass mass : {Mass::lumped, Mass::consistent}) {
      Body<3> body = shaken(mass, skin);
      const BudgetRow end = run(body, 1.0 / 120, 40, 1, integrator).rows().back();
      EXPECT_GT(end.damping, 0.01);
      EXPECT_GE(end.numerical_loss, integrator == Integrator::backward_euler ? 0.01 : 0);
      EXPECT_GT(std::abs(end.pin_work), 0.01);
      EXPECT_GT(end.energy.kinetic, 0.01);
      EXPECT_NE(end.jumps, 0);  // bending, at the least
      EXPECT_NEAR(end.remainder, 0, 1e-11 * (end.damping + std::abs(end.pin_work)));
    }
}

/// The explicit step's loss is no more than the step allows, and has either sign.
TEST(EnergyBudget, OfALinearSheetInExplicitStepsClosesToRounding) {
  Material material = skin;
  for (const double damping : {0.0, 1e-5}) {
    material.stiffness_damping = damping;
    Body<3> body = shaken(Mass::lumped, material);
    const EnergyBudget budget = run(body, 2e-5, 4000, 1, Integrator::symplectic_euler);
    const BudgetRow end = budget.rows().back();
    EXPECT_GT(std::abs(end.pin_work), 0.01);
    EXPECT_GT(end.damping, 1e-3);
    EXPECT_NEAR(end.remainder, 0, 1e-10 * (std::abs(end.pin_work) + end.energy.kinetic));
    EXPECT_LT(std::abs(end.numerical_loss), 0.02 * end.energy.kinetic);
    EXPECT_EQ(budget.fault(), "");
  }
}

/// One linearisation per step is off by a power of the step; a second nearly removes it.
TEST(EnergyBudget, TheRemainderIsTheErrorOfTheLinearisation) {
  std::vector<double> remainder;
  for (const auto& [step, newton] : {std::pair{1.0 / 60, 1}, {1.0 / 240, 1}, {1.0 / 60, 3}}) {
    Body<3> body(make_sheet("alternating", 8), skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}},
                 {{.where = {{0, 0}, {0, 1}}}});
    remainder.push_back(std::abs(run(body, step, to_int(0.4 / step + 0.5), newton).rows().back().remainder));
  }
  EXPECT_GT(remainder[0], 1e-6);
  EXPECT_LT(remainder[1], remainder[0] / 2);
}

TEST(EnergyBudget, JumpsAreJudgedByThemselves) {
  Balance first, more, less;
  first.energy.membrane = 10;
  more.energy.membrane = 13;
  less.energy.membrane = 6;
  EnergyBudget budget(first);
  EXPECT_EQ(budget.fault(), "");
  budget.add_cut(first, less);  // energy lost at a cut is no growth
  EXPECT_EQ(budget.gains().jumps, 0);
  budget.add_cut(first, more);
  EXPECT_NEAR(budget.gains().jumps, 3.0 / 13, 1e-15);
  EXPECT_EQ(budget.gains().remainder, 0);
  EXPECT_NE(budget.fault().find("jumps"), std::string::npos);
}

TEST(EnergyBudget, PotentialEnergyThatLeavesWithMaterialIsNoError) {
  Balance first, fewer;
  first.energy = {.membrane = 10, .potential = -50};
  fewer.energy = {.membrane = 9, .potential = -20};
  EnergyBudget kept(first), less(first);
  kept.add_cut(first, fewer);
  EXPECT_NE(kept.fault().find("jumps"), std::string::npos);
  less.add_cut(first, fewer, false);
  EXPECT_EQ(less.fault(), "");
  EXPECT_EQ(less.rows().back().jumps, 29) << "the budget closes all the same";
}

TEST(EnergyBudget, WhatFollowsTheVerdictDoesNotCount) {
  Balance first, more;
  first.energy.membrane = 10;
  more.energy.membrane = 13;
  EnergyBudget budget(first);
  budget.stop_judging();
  budget.add_cut(first, more);
  EXPECT_EQ(budget.gains().jumps, 0);
  EXPECT_EQ(budget.rows().back().jumps, 3);
}

/// A jump that the step right after loses again, in a cut that made a fold sharper, has moved nothing.
TEST(EnergyBudget, ARobustStepShowsWhatIsLeftOfAJump) {
  for (const bool robust : {false, true}) {
    Body<3> body = shaken(Mass::lumped, skin);
    StepOptions options = steps_of(1.0 / 120);
    options.robust = robust;
    Stepper<3> stepper(options);
    EnergyBudget budget(balance_of(body.model, body.state), Integrator::backward_euler, 0, 0, robust);
    const auto step = [&] {
      const State before = body.state;
      ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
      budget.add_step(body.model, before, body.state, 1.0 / 120);
    };
    for (int n = 0; n < 10; ++n) step();
    const Balance before = balance_of(body.model, body.state);
    const Eigen::Index inner = 3 * 40;
    body.state.x[inner + 2] += 0.02;  // as if a cut had done it: a dent
    const Balance after = balance_of(body.model, body.state);
    budget.add_cut(before, after);
    for (int n = 0; n < 5; ++n) step();
    const double jump = after.energy.total() - before.energy.total();
    const BudgetRow& end = budget.rows().back();
    EXPECT_NEAR(end.jumps, jump, 1e-12);
    if (robust)
      EXPECT_LT(budget.gains().jumps, 0.5 * jump / (after.energy.membrane + after.energy.bending));
    else
      EXPECT_GT(budget.gains().jumps, 0.9 * jump / (after.energy.membrane + after.energy.bending + 10));
  }
}

/// A push: velocities made larger between two steps are energy out of nowhere. So much damping that the total falls
/// even so.
TEST(EnergyBudget, GrowthIsWhatNothingExplains) {
  Material damped = skin;
  damped.mass_damping = 40;
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint}) {
    Body<3> body(make_sheet("grid", 4), damped, {.gravity = {0, 0, -9.81}}, {{.where = {{0, 0}, {0, 1}}}});
    Stepper<3> stepper(steps_of(0.01, 1, integrator));
    EnergyBudget pushed(balance_of(body.model, body.state), integrator);
    const auto step = [&](double push) {
      const State before = body.state;
      body.state.v *= push;
      EXPECT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
      pushed.add_step(body.model, before, body.state, 0.01);
    };
    for (int n = 0; n < 10; ++n) step(1);
    EXPECT_EQ(pushed.fault(), "");
    const double total = pushed.rows().back().energy.total();
    step(1.2);
    EXPECT_LT(pushed.rows().back().energy.total(), total);
    EXPECT_NE(pushed.fault().find("remainder"), std::string::npos);
  }
}

}  // namespace
}  // namespace cutbench
