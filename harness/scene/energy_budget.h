// Where the energy of a moving sheet goes, step by step. The step of backward Euler, M dv = h (f - alpha M v - beta K
// v) with f linearised at its start, multiplied by its displacement dx = h v:
//
//   change of (kinetic + elastic + potential) = work of the pins - h (alpha v'Mv + beta v'Kv)        damping
//                                             - (dv'M dv + dx'K dx) / 2                               numerical loss
//                                             + remainder
//
// The remainder is the error of the linearisation (with K made positive) and of the linear solver: zero to rounding for
// a linear sheet and a direct solver.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/fem/state.h"

namespace cutbench {

/// After a step; J. The values below the energy are sums from the beginning.
struct BudgetRow {
  double time = 0;  ///< s
  Energy energy;
  double pin_work = 0;        ///< done by what moves the pins
  double damping = 0;         ///< lost
  double numerical_loss = 0;  ///< lost by backward Euler
  double jumps = 0;           ///< of the total at cuts
  double remainder = 0;       ///< gained, and not explained by the above
};

class EnergyBudget {
 public:
  /// \pre balance_of() the first moment.
  explicit EnergyBudget(const Balance& first);

  /// After a step of backward Euler from `before` to `after`: \pre the model's matrix is still that step's.
  template <int D>
  void add_step(Model<D>& model, const State& before, const State& after, double step);
  void add_cut(const Balance& before, const Balance& after);

  const std::vector<BudgetRow>& rows() const { return rows_; }
  /// The largest rise of the total, less work of pins and jumps, over any span of time, relative to the largest
  /// kinetic + elastic energy so far. Only an error can raise it.
  double growth() const;
  /// CSV. Throws OutputError.
  void write(const std::filesystem::path& file) const;

 private:
  std::vector<BudgetRow> rows_;
};

}  // namespace cutbench
