// Vertex block descent, against the linear solves of backward Euler.
#include "harness/fem/time/vertex_block_descent.h"

#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "tests/cut_flag.h"

namespace cutbench {
namespace {

constexpr double h = 1.0 / 60;

StepOptions swept(int sweeps, double step = h) {
  return {.integrator = Integrator::vbd, .step = step, .sweeps = sweeps, .solver = {}};
}

template <int D>
void expect_backward_euler(Strain strain, BendingKind bending, double damping) {
  SCOPED_TRACE(name_of(strain_names, strain));
  Material material = flag_skin;
  material.stiffness_damping = damping;
  auto swept_sheet = cut_flag<D>(strain, bending, material), solved_sheet = swept_sheet;
  const Field start = swept_sheet.state.x;
  advance(swept_sheet, swept(1500), 5);
  advance(solved_sheet,
          {.integrator = Integrator::backward_euler, .step = h, .newton = 40, .solver = {.name = "cholmod"}}, 5);
  const double moved = (solved_sheet.state.x - start).cwiseAbs().maxCoeff();
  EXPECT_GT(moved, 0.01);
  EXPECT_LT((swept_sheet.state.x - solved_sheet.state.x).cwiseAbs().maxCoeff(), 1e-6 * moved);
}

/// Where sweeps change nothing any more, the step is that of Newton's method. (With stiffness damping Newton's steps
/// have the tangent at their end, too.)
TEST(VertexBlockDescent, ManySweepsAreBackwardEuler) {
  for (const Strain strain : {Strain::corotational, Strain::green, Strain::springs}) {
    expect_backward_euler<2>(strain, BendingKind::none, 0);
    expect_backward_euler<3>(strain, BendingKind::none, 0);
  }
  expect_backward_euler<3>(Strain::corotational, BendingKind::patches, 0);
  expect_backward_euler<3>(Strain::linear, BendingKind::hinges, 2e-3);
}

/// The energy that a step minimises falls with every sweep, also where the sheet is very stiff and torn about.
TEST(VertexBlockDescent, EverySweepGoesDownhill) {
  Material stiff = flag_skin;
  stiff.stiffness = 1e5;
  stiff.stiffness_damping = stiff.mass_damping = 0;
  auto body = cut_flag<3>(Strain::corotational, BendingKind::patches, stiff);
  Field x0 = body.state.x, y = x0;
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 0.05 * std::sin(12.9898 * to_double(to_size(i)));
  for (std::size_t i = 0; i < body.model.held().size(); ++i)
    if (body.model.held()[i] != 0) y[to_index(i)] = x0[to_index(i)];
  const auto phi = [&](const Field& x) {
    body.model.rotate(x);
    const Energy energy = body.model.energy(x, Field::Zero(x.size()));
    Field pull = Field::Zero(x.size());
    body.model.add_mass_product(1, x - y, pull);
    return energy.membrane + energy.bending + pull.dot(x - y) / (2 * h * h);
  };
  Field x = y;
  double last = phi(x);
  const double first = last;
  for (int sweep = 0; sweep < 40; ++sweep) {
    VertexBlockDescent<3>().solve(body.model, h, 1, x0, y, x);
    const double now = phi(x);
    EXPECT_LE(now, last * (1 + 1e-12)) << sweep;
    last = now;
  }
  EXPECT_LT(last, 0.1 * first);
}

/// A sheet that hangs still begins its next step where it hangs, so that few sweeps keep it there.
TEST(VertexBlockDescent, FewSweepsKeepASheetHanging) {
  auto body = cut_flag<3>(Strain::green, BendingKind::patches);
  const Field start = body.state.x;
  advance(body, {.integrator = Integrator::equilibrium, .newton = 200, .solver = {.name = "cholmod"}}, 1);
  const Field hangs = body.state.x;
  body.state.v.setZero();
  body.state.dv.setZero(hangs.size());
  advance(body, swept(2), 60);
  const double moved = (hangs - start).cwiseAbs().maxCoeff();
  EXPECT_GT(moved, 0.1);
  EXPECT_LT((body.state.x - hangs).cwiseAbs().maxCoeff(), 1e-3 * moved);
}

}  // namespace
}  // namespace cutbench
