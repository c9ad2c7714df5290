// A running simulation and the cuts made in it. A cut comes right after a step; then the state of new vertices is
// transferred, the model is updated, and the next step follows. A scene's own cuts are made by advance() when they are
// due; in a loop of one's own, step() and cut_now() do the same, bit for bit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "harness/cut/cut_all.h"
#include "harness/fem/time/step_report.h"
#include "harness/simulation/energy_budget.h"
#include "harness/simulation/motion_cut.h"
#include "harness/simulation/scene.h"
#include "harness/simulation/step_log.h"

namespace cutbench {

/// How the steps of a simulation went: `ok`, or what went wrong with them, first. A verdict that ends the simulation
/// takes the place of one that doesn't.
///   not_finite      a position, velocity or energy: ends it
///   solver_stalled  the linear solver did not reach its tolerance, or a piece at rest is held nowhere: ends it
///   newton_failed   Newton's method did not converge (StepReport::newton_residual): ends it
///   timed_out       it took longer than limit_time(): ends it
///   inverted        triangles are turned over (turned_over.h): any in the plane, over 1 % of the area in space
///   energy_growth   energy came from nowhere (EnergyBudget::fault())
/// What follows a verdict that is not ok does not count, neither steps nor cuts.
struct SimulationOutcome {
  Verdict verdict = Verdict::ok;
  std::string reason;        ///< of a verdict that is not ok; of one that is: which cuts were refused, and why
  double time = 0;           ///< s, simulated: when it was found
  std::size_t steps = 0;     ///< that count
  std::size_t cuts = 0;      ///< that count
  std::size_t refused = 0;   ///< of these cuts
  bool only_shapes = false;  ///< were judged, for the integrator keeps no energy budget
  std::string text() const;  ///< one line: "ok", or "ok, but ...", or the verdict with its time and its reason
};

/// Largest stable steps of symplectic Euler, s (explicit_step_limit()); NaN with constrained vertices and of springs.
struct StepLimits {
  double membrane = 0, with_bending = 0;
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
  /// Makes one step; the scene's own cuts wait for advance(). A report that is not ok ends the simulation: outcome().
  virtual StepReport step() = 0;
  /// Makes a cut right now, before the step that is next: the curves one after the other, as a cut of the scene with
  /// these curves would be made. \return  what came of it. A curve that is refused, or fails (`verdict`), or has
  /// nothing to cut leaves sheet, state and model bit-unchanged; after a failure the curves behind it are not tried.
  /// \param curves  rest space, m; for points in world space see Picker, with posed_sheet()
  /// \param method  the same in all cuts of a simulation, where it constrains vertices or merges triangles
  /// \throw InputError  before anything is changed: no curve, one that check_curve() refuses, or a scene with an active
  ///                    radius, which has to know all cuts from the start
  virtual MotionCut cut_now(std::span<const Curve> curves, CuttingMethod& method, const CutOptions& options = {}) = 0;
  /// From now on forces pull at the vertices besides the scene's loads. \param force  N: two or three numbers, as the
  /// scene has dimensions, for each slot of a deformed vertex; vertices that later cuts make have none. Empty: none
  /// at all. \throw InputError  another number of them, or one that is not finite
  virtual void pull(std::span<const double> force) = 0;
  /// From now on these pins hold the sheet, and no others: vertices where they are now, moved with the velocity. A
  /// displacement has no effect.
  virtual void hold(const std::vector<Pin>& pins) = 0;
  /// m and m/s: two or three numbers, as the scene has dimensions, for each slot of a deformed vertex. Valid until the
  /// next step or cut.
  virtual std::span<const double> positions() const = 0;
  virtual std::span<const double> velocities() const = 0;
  /// Makes one step, the cuts, and one more step, and then restores the state before.
  virtual MotionCut try_cut(const std::vector<Curve>& cuts, Cutter& cutter, CuttingMethod& method,
                            const CutOptions& options) = 0;
  virtual Sheet tried_sheet() const = 0;  ///< posed, as the last try_cut() left it before the state was restored
  virtual Balance balance() = 0;
  virtual const std::vector<MotionCut>& made_cuts() const = 0;  ///< by advance() and cut_now(), with what jumped
  virtual const std::vector<LoggedStep>& steps() const = 0;     ///< made by advance() and step()
  virtual double time() const = 0;
  /// From now on every step is judged by its energies and shapes, outside the step's clock: a quarter of a step more.
  virtual void watch() = 0;
  virtual const EnergyBudget* budget() const = 0;  ///< none where it isn't watched, and in equilibrium
  /// Of the steps so far, and of cuts that advance() made; energies and shapes only where it is watched.
  virtual SimulationOutcome outcome() const = 0;
  /// advance() makes no more steps once the process has taken so long from now on. \param seconds  of processor time
  virtual void limit_time(double seconds) = 0;
  /// Of the sheet as it is cut now, at rest and with nothing held; NaN where the method constrains vertices. Looks at
  /// everything.
  virtual StepLimits step_limits() = 0;
};

}  // namespace cutbench
