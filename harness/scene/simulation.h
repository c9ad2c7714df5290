// A cut where it happens: inside a running simulation, right after a step, with what follows it: the state carried
// over, the model brought up to date, and the first step after.
#pragma once

#include <memory>

#include "harness/cut/cut_all.h"
#include "harness/fem/stepper.h"
#include "harness/scene/energy_budget.h"
#include "harness/scene/scene.h"

namespace cutbench {

/// One cut in motion. Microseconds, steady clock; nothing is warmed up.
struct MotionCut {
  CutRun cut;
  std::string verdict = "ok", reason;  ///< of the cut and of the steps before and after it
  std::size_t parts = 0;               ///< it was made in: by a blade, one a step; below are sums over them
  double pick_us = 0;                  ///< the sheet as it is then into a tree, and the picks carried to rest space
  double transfer_us = 0;              ///< state of new vertices
  double pattern_us = 0;               ///< element data, mass, loads and the pattern of the system
  double bending_us = 0;               ///< stencils and rows of the bending matrix
  StepReport first_step;
  double rebuild_us = 0;          ///< (b): instead of `pattern`, all of that made anew
  double bending_rebuild_us = 0;  ///< (b): instead of `bending`
  double triplets_us =
      0;                  ///< (c): instead of `assemble`, by Eigen's setFromTriplets, scalar entries, triplets included
  Balance before, after;  ///< of the instant; of a blade's cut, `after` has all that jumped, without what moved between
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
  /// Goes on from here by one step, cuts, and steps again; then all is as it was before.
  virtual MotionCut try_cut(const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                            const CutOptions& options) = 0;
  virtual Balance balance() = 0;
  virtual const std::vector<MotionCut>& made_cuts() const = 0;  ///< by advance(), with what jumped
  virtual double time() const = 0;
  /// From now on every step goes into the budget, where the integrator is backward Euler.
  virtual void keep_budget() = 0;
  virtual const EnergyBudget* budget() const = 0;  ///< none where it isn't kept
};

}  // namespace cutbench
