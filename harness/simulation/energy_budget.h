// Where the energy of a moving sheet goes, step by step. Each integrator's step moves the sheet by dx = h u, with
// forces f at a place x* of the step and damping of a velocity w; the pins supply what is missing:
//
//   M dv = h (f(x*) + f_ext - alpha M w - beta K w + f_pins)
//
//   backward Euler    u = w = v,               x* = x0 + dx      loss = (dv'M dv + dx'K dx) / 2
//   midpoint          u = w = (v0 + v) / 2,    x* = x0 + dx / 2  loss = 0 but for pins that set off
//   symplectic Euler  u = v, w = v0,           x* = x0           loss = (dv'M dv + dx'(f(x) - f(x0))) / 2
//
// Multiplied by dx:
//
//   change of (kinetic + elastic + potential) = work of the pins - h u'(alpha M w + beta K w)   damping
//                                             - loss                                            numerical loss
//                                             + remainder
//
// A robust step of backward Euler (harness/fem/time/stepper_robust.cpp) is no linear one: its elastic loss is
// E(x0) - E(x) - f_int(x)'(x - x0) instead of dx'K dx / 2. It is negative where the energy is not convex on the way.
//
// The remainder is the error of the linearisation (with K made positive) and of the linear solver: zero to rounding for
// a linear sheet and a direct solver. The loss of symplectic Euler has either sign; it is bounded where the step is
// stable, and a gain without bounds where it is not.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "harness/fem/elements/physics.h"
#include "harness/fem/model/energy.h"

namespace cutbench {

struct State;
template <int D>
class Model;
template <int D>
struct SystemMatrix;

/// After a step; J. The values below the energy are sums from the beginning.
struct BudgetRow {
  double time = 0;  ///< s
  Energy energy;
  double pin_work = 0;        ///< done by what moves the pins, and by forces that were set
  double damping = 0;         ///< lost
  double numerical_loss = 0;  ///< lost by the integrator
  double jumps = 0;           ///< of the total at cuts
  double remainder = 0;       ///< gained, and not explained by the above
};

/// Of these the energy of each step can be accounted for. At rest there is no step; the forces that sweeps
/// leave over are not known.
constexpr bool keeps_budget(Integrator integrator) {
  return integrator != Integrator::equilibrium && !sweeps(integrator);
}

class EnergyBudget {
 public:
  /// The largest rises over any span of time, relative to the largest kinetic + elastic energy so far: of the
  /// remainder, which only an error can raise and no damping or loss can hide; of the sum of the jumps, which are
  /// errors of the mesh, for a cut does not move the sheet; and of the total, less work of pins and jumps.
  struct Gains {
    double remainder = 0, jumps = 0, unexplained = 0;
  };
  /// A scene whose gains exceed them has the verdict energy_growth. The errors of an explicit step are in its loss and
  /// its damping, and even a stable one lets the total swing.
  static constexpr double most_remainder = 0.05, most_jumps = 0.05, most_unexplained = 0.01,
                          most_unexplained_explicit = 0.5;

  /// \param noise  J: energies below it are rounding
  /// \param time   s, of the first moment
  /// \param robust  the steps are
  /// \pre balance_of() the first moment; the integrator is not equilibrium.
  explicit EnergyBudget(const Balance& first, Integrator integrator = Integrator::backward_euler, double noise = 0,
                        double time = 0, bool robust = false);

  /// After a step from `before` to `after`: \pre the model's matrix is still that step's.
  /// \param damping  Stepper::damping_matrix(); null: the model's
  template <int D>
  void add_step(Model<D>& model, const State& before, const State& after, double step,
                const SystemMatrix<D>* damping = nullptr);
  /// \param keeps_mass  no material left the sheet. Potential energy that leaves with it is no error: its sign is that
  /// of the height over an origin which nobody chose.
  void add_cut(const Balance& before, const Balance& after, bool keeps_mass = true);
  /// After other pins or forces were set: what that changes is work of theirs.
  void add_work(const Balance& before, const Balance& after);

  const std::vector<BudgetRow>& rows() const { return rows_; }
  Gains gains() const;
  /// From now on the rows go on, but gains and fault stay as they are.
  void stop_judging() { judged_rows_ = rows_.size(); }
  /// The last row that gains and fault count.
  const BudgetRow& end() const { return judged_rows_ == 0 ? rows_.back() : rows_[judged_rows_ - 1]; }
  /// What exceeds its bound, in words; empty: nothing.
  std::string fault() const;
  std::string csv() const;  ///< a row for each moment, under a head

 private:
  /// The largest rise over any span.
  struct Rise {
    double lowest = 0, largest = 0;
    void add(double value) { lowest = std::min(lowest, value), largest = std::max(largest, value - lowest); }
  };
  void judge_last();
  void count_jump(double loss);

  Integrator integrator_;
  bool exact_loss_;  // of robust steps
  std::vector<BudgetRow> rows_;
  double scale_;
  double counted_jumps_ = 0;     ///< J: sum of what the jumps count
  double new_jump_ = 0;          ///< J: of robust steps, until the next one shows what is left of it
  double usual_loss_ = 0;        ///< J: numerical, of the last step without a cut before it
  bool has_cut_ = false;         ///< since the last step
  std::size_t judged_rows_ = 0;  ///< 0: all, for it still judges
  Rise remainder_, jumps_, unexplained_;
};

}  // namespace cutbench
