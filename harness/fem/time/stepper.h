// Time integration, and equilibrium. Every implicit step is written as a residual in the new velocity v:
//
//   r(v) = M (v - v0) - h (f(x0 + h v) + f_ext - alpha M v - beta K v)
//
// and solved by Newton's method with the positive semi-definite tangent K, A = (1 + h alpha) M + (h beta + h^2) K. The
// first iteration is linearised at x0 (Baraff and Witkin, Large steps in cloth simulation, 1998): A dv = h (f(x0) +
// f_ext) + M v0 - A v0. Further ones are at x0 + h v.
//
//   backward_euler    as above; x = x0 + h v. First order; damps.
//   midpoint          the same with h / 2 gives vm, the velocity at the middle of the step; v = 2 vm - v0,
//                     x = x0 + h vm. Second order; no numerical damping of linear motion. It can gain energy where
//                     large rotations are stiff (slivers, few Newton iterations).
//   symplectic_euler  v = v0 + h M^-1 f(x0, v0); x = x0 + h v. Explicit: stable below 2 / omega_max. Mass that was
//                     added to thin elements is factored after each cut (mass_solver.h), all other is lumped.
//   xpbd              as backward_euler, but by sweeps over the elements instead of a linear solve (xpbd.h)
//   vbd               as xpbd, but by sweeps over the vertices (vertex_block_descent.h)
//   equilibrium       f(x) + f_ext = 0 by Newton with a line search on the energy.
//
// Where vertices are constrained, x = x0 + C q, the implicit integrators solve C^T A C dq = C^T rhs.
#pragma once

#include <memory>
#include <string>

#include "harness/fem/algebra/workers.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/linear/mass_solver.h"
#include "harness/fem/model/state.h"
#include "harness/fem/time/step_report.h"
#include "harness/fem/time/vertex_block_descent.h"
#include "harness/fem/time/xpbd.h"

namespace cutbench {

struct StepOptions {
  Integrator integrator = Integrator::backward_euler;
  double step = 1.0 / 240;  ///< s
  int newton = 1;           ///< linear solves per step; equilibrium: at most
  int sweeps = 1;           ///< of xpbd and vbd, per step
  SolverOptions solver;
  /// Of implicit steps: further solves with a line search where the first leaves more energy than it should
  /// (stepper_robust.cpp). \pre newton is 1
  bool robust = false;
};

template <int D>
class Stepper {
 public:
  /// Throws InputError for an unknown solver, and for less than one thread. Symplectic Euler and sweeps take no
  /// consistent mass (scenes refuse it), and no constrained vertices, except that symplectic Euler takes those whose
  /// unknowns have a mass of their own (Constraints::lumped), without an added one; sweeps no elements of several
  /// triangles and no added mass either.
  explicit Stepper(const StepOptions& options);
  StepReport step(Model<D>& model, State& state);
  /// A of stepper.h with the K that the damping of the last step had: refers to this and the model. It is the model's,
  /// but after further solves of a robust step: there the damping keeps that of the first, since solves whose damping
  /// changes under them run in circles.
  SystemMatrix<D> damping_matrix(const Model<D>& model) const;

 private:
  void implicit_step(Model<D>& model, State& state, double h, StepReport& report);
  void finish_robustly(Model<D>& model, const State& state, double h, const Energy& before, StepReport& report);
  double merit(Model<D>& model, const State& state, double h, const Field& v, const Field& x, Energy& energy);
  void residual(Model<D>& model, const State& state, double h);
  double gain(Model<D>& model);
  bool may_gain(double gain, const Energy& energy);
  void place_at_end(const Model<D>& model, const State& state, double h, const Field& v, Field& x) const;
  void right_hand_side(Model<D>& model, const State& state, double h, bool first, StepReport& report);
  void explicit_step(Model<D>& model, State& state, StepReport& report);
  void position_step(Model<D>& model, State& state, StepReport& report);
  void expect_positions(const Model<D>& model, const State& state, Field& x) const;
  void solve_added_mass(const Model<D>& model, const State& state, StepReport& report);
  void equilibrium(Model<D>& model, State& state, StepReport& report);
  void solve(Model<D>& model, const Field& start, StepReport& report);
  void judge_newton(const Model<D>& model, double h, double before2, double last2, StepReport& report);
  void hold(Model<D>& model, const State& state, double h);
  void forces(Model<D>& model, const Field& x, StepReport& report);

  StepOptions options_;
  Workers workers_;
  std::unique_ptr<LinearSolver<D>> solver_;
  MassSolver<D> mass_solver_;
  Xpbd<D> xpbd_;
  VertexBlockDescent<D> vertex_block_descent_;
  std::uint64_t mass_of_ = 0;               // the change of the model that it was set up after
  double gained_ = 0, largest_energy_ = 0;  // J: of robust steps
  bool keeps_damping_ = false;              // damping_matrix() is not the model's
  BlockMatrix<D> damping_blocks_;
  Field v_, x_, force_, rhs_, dv_, product_, reduced_, first_rhs_, first_v_, trial_, inertial_;  // kept between steps
};

}  // namespace cutbench
