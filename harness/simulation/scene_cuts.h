// The cuts of a scene in motion, made when they are due: all at once, or part by part where a blade advances with the
// steps; and cuts between two steps that no scene knows of. Before the first one, what is far from all of them may be
// left out (harness/simulation/active_region.h).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/path/blade.h"
#include "harness/path/pick.h"
#include "harness/simulation/energy_budget.h"
#include "harness/simulation/motion_cut.h"
#include "harness/simulation/moving_sheet.h"
#include "harness/simulation/step_log.h"

namespace cutbench {

template <int D>
class SceneCuts {
 public:
  /// Keeps references to both. Throws InputError. \pre `now` is not cut yet
  SceneCuts(const Scene& scene, MovingSheet<D>& now);
  SceneCuts(const SceneCuts&) = delete;
  SceneCuts& operator=(const SceneCuts&) = delete;

  /// In their order, those of make_now() among them.
  const std::vector<MotionCut>& made() const { return made_; }

  /// To be called before each step. Does nothing but where the first cut is due and the scene has an active radius.
  /// True: it left something out, so an energy budget has to begin anew.
  bool leave_out_far_parts();
  /// Makes the cuts, and parts of cuts, that are due before the step that is next. Returns the first one whose verdict
  /// is not ok, or null. Throws InputError where a pick misses the sheet. \param budget  the cuts' jumps go there; may
  /// be null
  const MotionCut* make_due(CuttingMethod& method, const CutOptions& options, EnergyBudget* budget);
  /// Makes a cut that is not the scene's, before the step that is next: see Simulation::cut_now().
  const MotionCut& make_now(std::span<const Curve> curves, CuttingMethod& method, const CutOptions& options,
                            EnergyBudget* budget);
  /// What all that cost since it was last asked for, without a step.
  LoggedStep take_log();

  /// Any cut, in any copy of the sheet: cuts, and carries state and model over. Neither made() nor the log know it.
  MotionCut cut(MovingSheet<D>& moving, std::span<const Curve> curves, Cutter& cutter, CuttingMethod& method,
                const CutOptions& options) const;

 private:
  struct DueCut {
    double time, speed;
    std::vector<Curve> curves;
    PickedCurve picked;
    std::optional<Blade> blade = {};       ///< while it is on its way
    double reached = 0;                    ///< m: what it has cut
    std::optional<std::size_t> made = {};  ///< its place in made_, from its time on
  };

  bool is_due(const DueCut& cut) const;
  void begin(DueCut& due, CuttingMethod& method, const CutOptions& options, EnergyBudget* budget);
  void advance_blade(DueCut& due, CuttingMethod& method, const CutOptions& options, EnergyBudget* budget);
  MotionCut cut_with_balances(std::span<const Curve> curves, CuttingMethod& method, const CutOptions& options,
                              EnergyBudget* budget);
  std::string why_not(const ConstraintSource* source) const;

  const Scene& scene_;
  MovingSheet<D>& now_;
  Sheet before_cuts_;
  Cutter cutter_;
  std::vector<DueCut> cuts_;
  std::vector<MotionCut> made_;
  LoggedStep log_;
};

}  // namespace cutbench
