#include "harness/fem/time/stepper.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/fem/time/phase_clock.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

namespace {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.1e", value);
  return buffer;
}

template <int D>
void project(const Model<D>& model, Field& f) {
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.held()[i]) f[to_index(i)] = 0;
}

}  // namespace

template <int D>
Stepper<D>::Stepper(const StepOptions& options) : options_(options), workers_(options.solver.threads.value_or(1)) {
  if (solves(options.integrator)) solver_ = make_solver<D>(options.solver, workers_);
}

template <int D>
SystemMatrix<D> Stepper<D>::damping_matrix(const Model<D>& model) const {
  SystemMatrix<D> a = model.system();
  if (keeps_damping_) a.blocks = &damping_blocks_;
  return a;
}

template <int D>
StepReport Stepper<D>::step(Model<D>& model, State& state) {
  StepReport report;
  switch (options_.integrator) {
    case Integrator::backward_euler:
      implicit_step(model, state, options_.step, report);
      if (report.verdict != Verdict::ok) return report;
      state.x += options_.step * v_;
      state.v = v_;
      break;
    case Integrator::midpoint:
      implicit_step(model, state, options_.step / 2, report);
      if (report.verdict != Verdict::ok) return report;
      state.x += options_.step * v_;
      state.v = 2 * v_ - state.v;
      break;
    case Integrator::symplectic_euler:
      explicit_step(model, state, report);
      break;
    case Integrator::xpbd:
    case Integrator::vbd:
      position_step(model, state, report);
      break;
    case Integrator::equilibrium:
      equilibrium(model, state, report);
      break;
  }
  state.time += options_.step;
  for (std::size_t i = 0; i < model.held().size(); ++i) {
    if (!model.pinned(i)) continue;
    const auto k = to_index(i);
    state.x[k] = state.anchor[k] + model.held_displacement(i, state.time);  // exactly, so that rounding can't add up
    state.v[k] = options_.integrator == Integrator::equilibrium ? 0 : model.held_velocity(i);
  }
  model.follow(state.x);
  model.follow(state.v);
  if (!state.x.allFinite() || !state.v.allFinite()) {
    report.verdict = Verdict::not_finite;
    report.reason = "the state";
  }
  return report;
}

/// Deformations at x, and internal and external forces.
template <int D>
void Stepper<D>::forces(Model<D>& model, const Field& x, StepReport& report) {
  PhaseClock clock(report.time_us.rotate);
  model.rotate(x, workers_);
  force_.setZero(x.size());
  model.add_internal_force(x, force_);
  model.add_external_force(force_);
}

/// Solves A dv = rhs.
template <int D>
void Stepper<D>::solve(Model<D>& model, const Field& start, StepReport& report) {
  SystemMatrix<D> a = model.system();
  ConstrainedSystem<D>* const constrained = model.constrained();
  project(model, rhs_);
  if (constrained) {
    PhaseClock clock(report.time_us.assemble);
    constrained->assemble(a);
    constrained->reduce(model.held(), rhs_, reduced_);
    a = constrained->system();
  }
  {
    PhaseClock clock(report.time_us.setup);
    solver_->setup(a);
  }
  PhaseClock clock(report.time_us.solve);
  const SolveReport solved = solver_->solve(constrained ? reduced_ : rhs_, dv_, start);
  if (constrained) {
    reduced_ = dv_;
    constrained->expand(reduced_, dv_);
  }
  ++report.newton;
  report.iterations += solved.iterations;
  report.residual = std::max(report.residual, solved.residual);
  report.fallbacks += solved.fell_back;
  if (!solved.converged) {
    report.verdict = Verdict::solver_stalled;
    report.reason = options_.solver.name + " left a relative residual of " + text(solved.residual);
  }
}

/// Velocities of held unknowns: what brings them where they are to be after h. What is constrained to them goes along.
template <int D>
void Stepper<D>::hold(Model<D>& model, const State& state, double h) {
  const ConstrainedSystem<D>* const constrained = model.constrained();
  if (constrained) product_ = v_;
  for (std::size_t i = 0; i < model.held().size(); ++i) {
    if (!model.held()[i]) continue;
    const auto k = to_index(i);
    v_[k] = model.pinned(i) ? (state.anchor[k] + model.held_displacement(i, state.time + h) - state.x[k]) / h : 0;
  }
  if (!constrained) return;
  v_ -= product_;
  constrained->extrapolate(model.held(), v_);
  v_ += product_;
}

/// Leaves the velocity after (backward Euler), or half way through (midpoint), in v_.
template <int D>
void Stepper<D>::implicit_step(Model<D>& model, State& state, double h, StepReport& report) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  const double mass_factor = 1 + h * alpha, stiffness_factor = h * beta + h * h;
  Energy before;
  keeps_damping_ = false;
  double before2 = 0, last2 = 0;  // dv'A dv of the last two solves: Newton's decrement, squared
  v_ = state.v;
  hold(model, state, h);
  for (int iteration = 0; iteration < options_.newton && report.verdict == Verdict::ok; ++iteration) {
    const bool first = iteration == 0;
    x_ = state.x;
    if (!first) x_ += h * v_;
    {
      PhaseClock clock(report.time_us.rotate);
      if (options_.robust) {
        model.rotate_once(x_, workers_);
        before = model.energy(x_, state.v, workers_);
      } else {
        model.rotate(x_, workers_);
      }
    }
    {
      PhaseClock clock(report.time_us.assemble);
      model.assemble(mass_factor, stiffness_factor, workers_);
    }
    right_hand_side(model, state, h, first, report);
    if (options_.robust) {
      first_rhs_ = rhs_;
      first_v_ = v_;
    }
    solve(model, first ? state.dv : Field(), report);
    if (first) state.dv = dv_;
    v_ += dv_;
    before2 = std::exchange(last2, dv_.dot(rhs_));
  }
  if (options_.robust && report.verdict == Verdict::ok) finish_robustly(model, state, h, before, report);
  if (options_.newton > 2 && report.verdict == Verdict::ok) judge_newton(model, h, before2, last2, report);
}

/// Newton's steps have to become smaller (Deuflhard, Newton Methods for Nonlinear Problems, 2011, 2.1.1).
template <int D>
void Stepper<D>::judge_newton(const Model<D>& model, double h, double before2, double last2, StepReport& report) {
  report.newton_residual = before2 > 0 ? std::sqrt(std::abs(last2) / before2) : 0;
  if (last2 < before2) return;
  // What rounding of the positions makes of stiff elements: dv = eps |x| / h.
  const SystemMatrix<D> a = model.system();
  double noise2 = 0;
  for (std::size_t i = 0; i < model.vertices(); ++i)
    noise2 += a.diagonal(i).norm() * x_.template segment<D>(to_index(D * i)).squaredNorm();
  if (last2 <= 1e-28 * noise2 / (h * h)) return;
  report.verdict = Verdict::newton_failed;
  report.reason = "the last of " + std::to_string(options_.newton) + " Newton steps was " +
                  text(report.newton_residual) + " times as large as the one before";
}

/// \pre rotations and matrix are of this iteration.
template <int D>
void Stepper<D>::right_hand_side(Model<D>& model, const State& state, double h, bool first, StepReport& report) {
  PhaseClock clock(report.time_us.rotate);
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  rhs_ = h * model.external_force();
  model.add_mass_product(1, state.v, rhs_, workers_);
  if (first) return model.add_impulse(h, x_, 1, v_, rhs_, workers_);
  // beta K v from A v: K v = (A v - (1 + h alpha) M v) / (h beta + h^2)
  const double damped = beta / (beta + h);
  model.add_impulse(h, x_, damped, v_, rhs_, workers_);
  model.add_mass_product((damped - 1) * (1 + h * alpha), v_, rhs_, workers_);
}

template <int D>
void Stepper<D>::explicit_step(Model<D>& model, State& state, StepReport& report) {
  const double h = options_.step, alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  forces(model, state.x, report);
  if (beta > 0) {
    PhaseClock clock(report.time_us.assemble);
    model.assemble(0, beta, workers_);
    product_.setZero(state.v.size());
    model.system().add_product(state.v, product_, workers_);
    force_ -= product_;
  }
  {
    PhaseClock clock(report.time_us.solve);
    const ConstrainedSystem<D>* const constrained = model.constrained();
    if (constrained) {
      constrained->reduce(model.held(), force_, reduced_);
      force_ = reduced_;
    }
    v_ = state.v;
    for (Eigen::Index i = 0; i < v_.size(); ++i) {
      const double mass = model.lumped_mass()[i / D];
      if (mass > 0) v_[i] += h * (force_[i] / mass - alpha * v_[i]);
    }
    hold(model, state, h);
    if (constrained) constrained->extrapolate(model.held(), v_);
  }
  if (model.added_mass()) solve_added_mass(model, state, report);
  state.v = v_;
  state.x += h * v_;
}

template <int D>
void Stepper<D>::position_step(Model<D>& model, State& state, StepReport& report) {
  PhaseClock clock(report.time_us.solve);
  const double h = options_.step, alpha = model.material().mass_damping;
  v_ = state.v;
  for (Eigen::Index i = 0; i < v_.size(); ++i) {
    const double mass = model.lumped_mass()[i / D];
    if (mass > 0) v_[i] = (v_[i] + h * model.external_force()[i] / mass) / (1 + h * alpha);
  }
  hold(model, state, h);
  x_ = state.x + h * v_;
  if (options_.integrator == Integrator::vbd) {
    inertial_ = x_;
    expect_positions(model, state, x_);
    for (std::size_t i = 0; i < model.held().size(); ++i)
      if (model.held()[i]) x_[to_index(i)] = inertial_[to_index(i)];
    vertex_block_descent_.solve(model, h, options_.sweeps, state.x, inertial_, x_);
    state.dv = (x_ - state.x) / h - state.v;
  } else {
    xpbd_.solve(model, h, options_.sweeps, state.x, x_);
  }
  state.v = (x_ - state.x) / h;
  state.x = x_;
  report.iterations = options_.sweeps;
}

/// Where a step of vertex block descent begins: by velocity, and by as much of the outer acceleration as the last step
/// had of it, none to all.
template <int D>
void Stepper<D>::expect_positions(const Model<D>& model, const State& state, Field& x) const {
  const double h = options_.step;
  x = state.x + h * state.v;
  for (std::size_t v = 0; v < model.vertices(); ++v) {
    const double mass = model.lumped_mass()[to_index(v)];
    const auto at = to_index(D * v);
    if (!(mass > 0)) continue;
    const Eigen::Matrix<double, D, 1> outer = model.external_force().template segment<D>(at) / mass;
    double share = 1;
    if (state.dv.size() == x.size() && !outer.isZero(0))
      share = std::clamp(state.dv.template segment<D>(at).dot(outer) / (h * outer.squaredNorm()), 0.0, 1.0);
    x.template segment<D>(at) += h * h * share * outer;
  }
}

/// Corrects the velocities in v_ where vertices have added mass: M dv = h (f - alpha M v0), with dv given where held.
template <int D>
void Stepper<D>::solve_added_mass(const Model<D>& model, const State& state, StepReport& report) {
  if (const std::uint64_t now = model.system().pattern; std::exchange(mass_of_, now) != now) {
    PhaseClock clock(report.time_us.setup);
    mass_solver_.setup(model.lumped_mass(), model.added_mass()->matrix(), model.held());
  }
  PhaseClock clock(report.time_us.solve);
  const double h = options_.step, alpha = model.material().mass_damping;
  dv_ = h * alpha * state.v;
  for (Eigen::Index i = 0; i < v_.size(); ++i)
    if (model.held()[to_size(i)]) dv_[i] += v_[i] - state.v[i];
  rhs_ = h * force_;
  model.add_mass_product(-1, dv_, rhs_, workers_);
  dv_ = v_ - state.v;
  mass_solver_.solve(rhs_, dv_);
  v_ = state.v + dv_;
}

template <int D>
void Stepper<D>::equilibrium(Model<D>& model, State& state, StepReport& report) {
  if (const std::size_t pieces = model.unheld_pieces(); pieces > 0) {
    report.verdict = Verdict::solver_stalled;
    report.reason = std::to_string(pieces) + " pieces are held nowhere, so they have no equilibrium";
    return;
  }
  const Field still = Field::Zero(state.v.size());
  const ConstrainedSystem<D>* const constrained = model.constrained();
  x_ = state.x;
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.pinned(i))
      state.x[to_index(i)] = state.anchor[to_index(i)] + model.held_displacement(i, state.time + options_.step);
  if (constrained) {
    state.x -= x_;
    constrained->extrapolate(model.held(), state.x);
    state.x += x_;
  }
  state.v.setZero();
  double last_step = 1e300, last_slope = 1e300;
  for (int iteration = 0; iteration <= options_.newton; ++iteration) {
    forces(model, state.x, report);
    // The scale of the forces: what the elements and the loads pull with, before they cancel.
    double scale = model.external_force().norm();
    for (std::size_t i = 0; i < model.held().size(); ++i)
      if (model.held()[i]) scale += std::abs(force_[to_index(i)]);
    rhs_ = force_;
    project(model, rhs_);
    if (constrained) constrained->reduce(model.held(), rhs_, reduced_);
    const double left = constrained ? reduced_.norm() : rhs_.norm();
    report.newton_residual = scale > 0 ? left / scale : left;
    // Settled: the forces cancel, or rounding is all that the last step was.
    if (report.newton_residual <= 1e-10 || last_step <= 1e-13 * state.x.cwiseAbs().maxCoeff()) return;
    if (iteration == options_.newton) break;
    {
      PhaseClock clock(report.time_us.assemble);
      model.assemble(0, 1, workers_);
    }
    solve(model, Field(), report);
    if (report.verdict != Verdict::ok) return;
    // Backtracking (Nocedal and Wright, Numerical Optimization, 3.1): the direction goes downhill, since A is positive.
    const Energy energy = model.energy(state.x, still);
    const double size = energy.membrane + energy.bending + std::abs(energy.potential), slope = -rhs_.dot(dv_);
    double fraction = 1;
    for (;; fraction /= 2) {
      x_ = state.x + fraction * dv_;
      model.rotate(x_, workers_);
      const double reached = model.energy(x_, still).total();
      // Near the minimum rounding hides what is gained: above all in bending, which is a small difference of positions.
      if (reached <= energy.total() + 1e-4 * fraction * slope + 1e-10 * size || fraction < 1e-10) break;
    }
    state.x = x_;
    last_step = fraction < 1e-9 ? 1e300 : dv_.cwiseAbs().maxCoeff();
    // Settled, too: by Newton's decrement, twice what is left to gain (Boyd and Vandenberghe, Convex Optimization,
    // 9.5.1), when it is small or, by rounding, falls no more. Slivers leave forces far above 1e-10 of all, which do
    // next to no work.
    const double falls = -slope / last_slope;
    if ((fraction == 1 && -slope <= 1e-12 * size) || (-slope <= 1e-8 * size && falls > 0.5)) return;
    last_slope = -slope;
  }
  report.verdict = Verdict::newton_failed;
  report.reason = "no equilibrium after " + std::to_string(options_.newton) + " Newton iterations, relative residual " +
                  text(report.newton_residual);
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace cutbench
