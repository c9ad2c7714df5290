// All solvers on sheets that are cut: the same object from cut to cut, and whole runs.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "harness/fem/linear/factor.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/fem/time/stepper.h"
#include "tests/fem_helpers.h"
#include "tests/linear_systems.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

std::vector<Pin> held_left() { return {{.where = {{-1, -1}, {1e-9, 2}}}}; }

Field solution(LinearSolver<3>& solver, const SystemMatrix<3>& a, const Field& b) {
  solver.setup(a);
  Field x;
  EXPECT_TRUE(solver.solve(b, x).converged);
  return x;
}

const std::vector<Curve> cuts{line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                              polygon({{0.22, 0.63}, {0.41, 0.64}, {0.33, 0.81}})};

/// A cut, and two more solves with the sheet turned and bent: the oracle is a direct solver, new each time.
TEST(SolversAfterCuts, AgreeWithANewDirectSolver) {
  for (SolverOptions options : all_solvers())
    for (const std::string method : {"conventional_split", "warp_and_refine", "element_deletion"}) {
      SCOPED_TRACE(options.name + ", " + method);
      options.tolerance = 1e-9;
      Body<3> body(make_sheet("delaunay", 12), skin, {.bending = BendingKind::patches}, held_left());
      const auto kept = make_solver<3>(options);
      for (const Curve& curve : cuts) {
        body.cut(curve, method);
        const Field x = bent(body.model, body.sheet);
        for (const double bend : {0.0, 0.02, 0.04}) {
          body.model.rotate(x + bend * (11 * x.array()).sin().matrix());
          body.model.assemble(1, 1e-4);
          const SystemMatrix<3> a = body.model.system();
          const Field b = random_field(7, x.size());
          const Field exact = solution(*make_solver<3>({.name = has_cholmod() ? "cholmod" : "eigen_ldlt"}), a, b);
          EXPECT_LT((solution(*kept, a, b) - exact).norm(), 1e-5 * exact.norm());
        }
      }
    }
}

/// The criterion of equal results: 60 steps to a tolerance of 1e-8 agree to 1e-6 of the sheet's size.
TEST(SolversAfterCuts, SixtyStepsEndInOnePlace) {
  std::vector<Field> ends;
  const std::vector<SolverOptions> solvers = all_solvers();
  for (const SolverOptions& solver : solvers) {
    SCOPED_TRACE(solver.name);
    Body<3> body(make_sheet("delaunay", 8), skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}},
                 held_left());
    StepOptions options;
    options.integrator = Integrator::backward_euler;
    options.step = 1.0 / 240;
    options.solver = solver;
    options.solver.tolerance = 1e-8;
    Stepper<3> stepper(options);
    for (int n = 0; n < 60; ++n) {
      if (n == 10) body.cut(cuts[0], "conventional_split");
      if (n == 25) body.cut(cuts[1], "conventional_split");
      const StepReport report = stepper.step(body.model, body.state);
      ASSERT_EQ(report.verdict, Verdict::ok) << report.reason;
    }
    ends.push_back(body.state.x);
  }
  for (std::size_t k = 0; k < ends.size(); ++k)
    EXPECT_LT((ends[k] - ends.front()).cwiseAbs().maxCoeff(), 1e-6) << solvers[k].name;
}

}  // namespace
}  // namespace cutbench
