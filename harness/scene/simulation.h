// A running simulation and the cuts made in it. A cut comes right after a step; then the state of new vertices is
// transferred, the model is updated, and the next step follows.
#pragma once

#include <memory>

#include "harness/cut/cut_all.h"
#include "harness/fem/stepper.h"
#include "harness/scene/energy_budget.h"
#include "harness/scene/scene.h"
#include "harness/scene/step_log.h"

namespace cutbench {

/// A cut in a moving sheet. Times in microseconds, steady clock; nothing is warmed up.
struct MotionCut {
  CutRun cut;
  std::string verdict = "ok", reason;  ///< of the cut and of the steps before and after it
  std::size_t parts = 0;               ///< a blade cuts one part in each step; the times below are sums over the parts
  double pick_us = 0;      ///< building the tree of the deformed sheet, and carrying the picks to rest space
  double transfer_us = 0;  ///< state of new vertices
  double pattern_us = 0;   ///< element data, mass, loads and the pattern of the system
  double bending_us = 0;   ///< stencils and rows of the bending matrix
  StepReport first_step;
  double rebuild_us = 0;          ///< instead of `pattern`: a new model
  double bending_rebuild_us = 0;  ///< instead of `bending`: a new bending matrix
  double triplets_us = 0;  ///< instead of `assemble`: Eigen's setFromTriplets with scalar entries, triplets included
  /// Right before and after the cut. Of a blade's cut, `after` contains the sum of all jumps, without the motion
  /// between.
  Balance before, after;
};

class Simulation {
 public:
  virtual ~Simulation() = default;
  /// The scene at its first moment. Throws InputError.
  static std::unique_ptr<Simulation> start(const Scene& scene);

  virtual const Sheet& sheet() const = 0;
  virtual Sheet posed_sheet() const = 0;  ///< with the vertices where they are now
  /// Steps, with the scene's own cuts made by `method` when they are due. Returns the first report that is not ok, or
  /// the last one. Throws InputError where a pick misses the sheet.
  virtual StepReport advance(double time, CuttingMethod& method, const CutOptions& options) = 0;
  /// Makes one step, the cuts, and one more step, and then restores the state before.
  virtual MotionCut try_cut(const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                            const CutOptions& options) = 0;
  virtual Balance balance() = 0;
  virtual const std::vector<MotionCut>& made_cuts() const = 0;  ///< by advance(), with what jumped
  virtual const std::vector<LoggedStep>& steps() const = 0;     ///< made by advance()
  virtual double time() const = 0;
  /// From now on every step goes into the budget, where the integrator is backward Euler.
  virtual void keep_budget() = 0;
  virtual const EnergyBudget* budget() const = 0;  ///< none where it isn't kept
};

}  // namespace cutbench
