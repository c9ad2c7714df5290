// A step that goes on with Newton's method, with a line search, until its energy is what its linearisation says, and
// until what all steps have gained is little.
//
// The residual r(v) of stepper.h is the gradient of
//
//   phi(v) = E(x0 + h v) - f_ext (x0 + h v) + (v - v0)' M (v - v0) / 2 + h (alpha v' M v + beta v' K v) / 2
//
// for a given K in the damping (the incremental potential: Kane et al., Variational integrators and the Newmark
// algorithm, 2000, not read). A step of backward Euler at the minimum of phi gains no energy but from pins. One that
// ends elsewhere gains v'r, the work of what is left of the residual: the remainder of EnergyBudget. Single steps gain
// so little that no test of one step sees it, but in a stiff sheet that swings they all gain, so their sum is kept.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/time/phase_clock.h"
#include "harness/fem/time/stepper.h"

namespace cutbench {

namespace {

/// Newton's method ends where phi is within this share of the sheet's elastic and kinetic energy of what was expected:
/// half of what the verdict lets the energy rise (EnergyBudget::most_unexplained).
constexpr double energy_tolerance = 5e-3;
/// Of the sum of what steps gained, over the largest elastic and kinetic energy so far; the verdict allows 0.05. Beyond
/// it a step may gain next to nothing.
constexpr double most_gained = 0.02, next_to_nothing = 1e-6;
constexpr int most_iterations = 20, most_halvings = 12;
constexpr double sufficient_decrease = 1e-4;  // Nocedal and Wright, Numerical Optimization, 2006, 3.1

}  // namespace

/// Positions after h, exactly those that step() makes.
template <int D>
void Stepper<D>::place_at_end(const Model<D>& model, const State& state, double h, const Field& v, Field& x) const {
  x = state.x + h * v;
  if (h == options_.step)
    for (std::size_t i = 0; i < model.held().size(); ++i)
      if (model.pinned(i))
        x[to_index(i)] = state.anchor[to_index(i)] + model.held_displacement(i, state.time + options_.step);
  model.follow(x);
}

/// phi of v, whose positions x are; `energy` is that of the sheet. Rotates the model to x, and leaves A v in product_
/// where there is damping, with the matrix of that.
template <int D>
double Stepper<D>::merit(Model<D>& model, const State& state, double h, const Field& v, const Field& x,
                         Energy& energy) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  model.rotate_once(x, workers_);
  energy = model.energy(x, v, workers_);
  const Field dv = v - state.v;
  product_.setZero(v.size());
  model.add_mass_product(1, dv, product_, workers_);
  double phi = energy.membrane + energy.bending + energy.potential + dv.dot(product_) / 2 + h * alpha * energy.kinetic;
  if (beta == 0) return phi;
  product_.setZero(v.size());
  damping_matrix(model).add_product(v, product_, workers_);
  const double stiffness = (v.dot(product_) - 2 * (1 + h * alpha) * energy.kinetic) / (h * beta + h * h);
  return phi + h * beta * stiffness / 2;
}

/// Leaves -r(v_) in rhs_. \pre merit() of v_ and its positions x_ was the last
template <int D>
void Stepper<D>::residual(Model<D>& model, const State& state, double h) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  rhs_ = h * model.external_force();
  model.add_mass_product(1, state.v, rhs_, workers_);
  model.add_impulse(h, x_, 0, v_, rhs_, workers_);
  // beta K v from A v, as in right_hand_side()
  const double damped = beta / (beta + h);
  if (beta > 0) rhs_ -= damped * product_;
  model.add_mass_product((damped - 1) * (1 + h * alpha), v_, rhs_, workers_);
}

/// Of the step to v_, J. \pre rhs_ is that of residual(). Changes reduced_.
template <int D>
double Stepper<D>::gain(Model<D>& model) {
  if (model.constrained()) {
    model.constrained()->reduce(model.held(), rhs_, reduced_);
    return -v_.dot(reduced_);
  }
  double work = 0;
  for (Eigen::Index i = 0; i < v_.size(); ++i)
    if (!model.held()[to_size(i)]) work -= v_[i] * rhs_[i];
  return work;
}

/// A step may end that gains this much, and has this energy; false: it has to go on.
template <int D>
bool Stepper<D>::may_gain(double gain, const Energy& energy) {
  largest_energy_ = std::max(largest_energy_, energy.membrane + energy.bending + energy.kinetic);
  const double sum = std::max(gained_ + gain, 0.0);
  if (sum > most_gained * largest_energy_ && gain > next_to_nothing * largest_energy_) return false;
  gained_ = sum;
  return true;
}

/// After the first solve, from v_ at the beginning to `v` at its end: does phi change as the linearisation says, and if
/// not, further solves. \pre first_rhs_ is the right-hand side of the first solve, from first_v_, for all unknowns
template <int D>
void Stepper<D>::finish_robustly(Model<D>& model, const State& state, double h, const Energy& before,
                                 StepReport& report) {
  const double alpha = model.material().mass_damping, beta = model.material().stiffness_damping;
  const double mass_factor = 1 + h * alpha, stiffness_factor = h * beta + h * h;
  Energy energy;
  double phi = 0;
  {
    PhaseClock clock(report.time_us.rotate);
    place_at_end(model, state, h, v_, x_);
    phi = merit(model, state, h, v_, x_, energy);
    if (beta == 0) {
      product_.setZero(v_.size());
      model.system().add_product(v_, product_, workers_);
    }
    // The linearisation at x0: phi(0) - b'v + v'A v / 2, with b = h (f + f_ext) + M v0: that of the first solve, and
    // A times what it began from.
    const double expected = before.total() - v_.dot(first_rhs_) + (v_ / 2 - first_v_).dot(product_);
    residual(model, state, h);
    const double tolerance = energy_tolerance * (energy.membrane + energy.bending + energy.kinetic);
    if (std::abs(phi - expected) <= tolerance && may_gain(gain(model), energy)) return;
  }
  if (beta > 0) {
    damping_blocks_ = *model.system().blocks;
    keeps_damping_ = true;
  }
  for (int iteration = 1; iteration < most_iterations && report.verdict == Verdict::ok; ++iteration) {
    {
      PhaseClock clock(report.time_us.assemble);
      model.assemble(mass_factor, stiffness_factor, workers_);
    }
    solve(model, Field(), report);
    if (report.verdict != Verdict::ok) return;
    PhaseClock clock(report.time_us.rotate);
    const double start = phi, slope = dv_.dot(rhs_);
    double share = 1;
    for (int halving = 0;; ++halving, share /= 2) {
      trial_ = v_ + share * dv_;
      place_at_end(model, state, h, trial_, x_);
      phi = merit(model, state, h, trial_, x_, energy);
      if (phi <= start - sufficient_decrease * share * slope || halving == most_halvings) break;
    }
    v_ = trial_;
    residual(model, state, h);
    const double expected = start - (share - share * share / 2) * slope;
    const double scale = energy_tolerance * (energy.membrane + energy.bending + energy.kinetic);
    const bool is_expected = share == 1 && std::abs(phi - expected) <= scale && slope <= scale;
    if ((is_expected || slope <= 1e-3 * scale) && may_gain(gain(model), energy)) return;
  }
  if (report.verdict == Verdict::ok) gained_ = std::max(gained_ + gain(model), 0.0);
}

template void Stepper<2>::finish_robustly(Model<2>&, const State&, double, const Energy&, StepReport&);
template void Stepper<3>::finish_robustly(Model<3>&, const State&, double, const Energy&, StepReport&);

}  // namespace cutbench
