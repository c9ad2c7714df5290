// What tests of integrators that sweep share: a sheet that hangs from one side, cut from the other, and falls.
#pragma once

#include <gtest/gtest.h>

#include "harness/fem/time/stepper.h"
#include "tests/fem_helpers.h"

namespace cutbench {

const Material flag_skin{
    .density = 2.2, .stiffness = 100, .poisson = 0.3, .bending = 1e-2, .mass_damping = 0.5, .stiffness_damping = 2e-3};

template <int D>
Body<D> cut_flag(Strain strain, BendingKind bending = BendingKind::none, const Material& material = flag_skin) {
  Body<D> body(make_sheet("delaunay", 4), material,
               {.dimension = D, .strain = strain, .bending = bending, .gravity = {0, -9.81, D == 3 ? -5.0 : 0}},
               {{.where = {{0, 0}, {0, 1}}}});
  EXPECT_EQ(body.cut(line({0.45, 0.52}, {1.1, 0.47})), Status::ok);
  return body;
}

template <int D>
void advance(Body<D>& body, const StepOptions& options, int steps) {
  Stepper<D> stepper(options);
  for (int i = 0; i < steps; ++i) ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
}

}  // namespace cutbench
