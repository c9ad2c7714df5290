// Extended position-based dynamics, against the linear solves of backward Euler.

#include "harness/fem/time/xpbd.h"

#include <gtest/gtest.h>

#include <random>

#include "harness/base/conversions.h"
#include "tests/cut_flag.h"

namespace cutbench {
namespace {

constexpr double h = 1.0 / 60;

StepOptions swept(int sweeps, double step = h) {
  return {.integrator = Integrator::xpbd, .step = step, .sweeps = sweeps, .solver = {}};
}
StepOptions solved(int newton) {
  return {.integrator = Integrator::backward_euler, .step = h, .newton = newton, .solver = {.name = "cholmod"}};
}

template <int D>
double largest_difference(const Body<D>& a, const Body<D>& b) {
  return (a.state.x - b.state.x).cwiseAbs().maxCoeff();
}

/// All constraints are linear then, so that sweeps converge to the one solution, with both dampings.
TEST(Xpbd, ManySweepsOfALinearSheetAreBackwardEuler) {
  auto swept_sheet = cut_flag<3>(Strain::linear, BendingKind::patches), solved_sheet = swept_sheet;
  const Field start = swept_sheet.state.x;
  advance(swept_sheet, swept(30000), 5);
  advance(solved_sheet, solved(1), 5);
  EXPECT_GT((solved_sheet.state.x - start).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT(largest_difference(swept_sheet, solved_sheet), 1e-10);
  auto hinged = cut_flag<3>(Strain::linear, BendingKind::hinges), hinged_solved = hinged;
  advance(hinged, swept(30000), 5);
  advance(hinged_solved, solved(1), 5);
  EXPECT_LT(largest_difference(hinged, hinged_solved), 1e-10);
}

/// The frames turn while the multipliers grow, so it is not quite the same step.
template <int D>
void expect_close(Strain strain) {
  SCOPED_TRACE(name_of(strain_names, strain));
  auto swept_sheet = cut_flag<D>(strain), solved_sheet = swept_sheet;
  const Field start = swept_sheet.state.x;
  advance(swept_sheet, swept(300), 10);
  advance(solved_sheet, solved(12), 10);
  const double moved = (solved_sheet.state.x - start).cwiseAbs().maxCoeff();
  EXPECT_GT(moved, 0.05);
  EXPECT_LT(largest_difference(swept_sheet, solved_sheet), 0.02 * moved);
}
TEST(Xpbd, ManySweepsAreCloseToBackwardEuler) {
  for (const Strain strain : {Strain::corotational, Strain::green, Strain::springs}) {
    expect_close<2>(strain);
    expect_close<3>(strain);
  }
}

/// A single sweep is too soft; in a step of a tenth less so: each against many sweeps of the same steps.
TEST(Xpbd, SmallStepsAreBetterThanOneSweep) {
  const auto left_over = [](double step, int steps) {
    auto exact = cut_flag<3>(Strain::corotational), one = exact;
    advance(exact, swept(300, step), steps);
    advance(one, swept(1, step), steps);
    return largest_difference(one, exact);
  };
  const double large = left_over(h, 10), small = left_over(h / 10, 100);
  EXPECT_GT(large, 1e-3);
  EXPECT_LT(small, 0.2 * large);
}

/// Sweeps move vertices against each other only: a sheet that is held nowhere keeps its momentum.
TEST(Xpbd, ASweepKeepsTheMomentum) {
  Material undamped = flag_skin;
  undamped.mass_damping = 0;
  for (const Strain strain : {Strain::linear, Strain::corotational, Strain::green, Strain::springs}) {
    SCOPED_TRACE(name_of(strain_names, strain));
    Body<3> body(make_sheet("delaunay", 4), undamped, {.strain = strain, .bending = BendingKind::patches});
    ASSERT_EQ(body.cut(line({0.3, 0.52}, {0.7, 0.47})), Status::ok);
    std::mt19937_64 draw(1);
    std::uniform_real_distribution<double> some(-1, 1);
    for (double& v : body.state.v) v = some(draw);
    const Point3 before = balance_of(body.model, body.state).momentum;
    advance(body, swept(3), 5);
    const Point3 after = balance_of(body.model, body.state).momentum;
    EXPECT_NEAR(after.x, before.x, 1e-12);
    EXPECT_NEAR(after.y, before.y, 1e-12);
    EXPECT_NEAR(after.z, before.z, 1e-12);
  }
}

/// Pins move as they are told, and what is between them follows.
TEST(Xpbd, PinsDrawASheetApart) {
  std::vector<Pin> pins{{.where = {{0, 0}, {0, 1}}}, {.where = {{1, 0}, {1, 1}}, .velocity = {0.5, 0, 0}}};
  Body<2> body(make_sheet("grid", 4), flag_skin, {.dimension = 2}, pins);
  advance(body, swept(200), 12);
  double mean = 0, count = 0;
  for (std::size_t v = 0; v < body.model.vertices(); ++v) {
    const Point2 rest = body.sheet.rest(body.sheet.rest_vertex(DeformedIndex(v)));
    const double x = body.state.x[to_index(2 * v)];
    if (rest.x == 1) {
      EXPECT_NEAR(x, 1.1, 1e-12);
    }
    if (rest.x == 0.5) {
      mean += x;
      ++count;
    }
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(mean / count, 0.55, 0.02);
}

}  // namespace
}  // namespace cutbench
