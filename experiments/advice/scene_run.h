// A scene run from its start to its end, and what is read off the sheet there. For `cutbench ablate` and `recommend`.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/simulation/simulation.h"

namespace cutbench {

double distance(Point3 a, Point3 b);             ///< m
bool in_use(const Sheet& sheet, std::size_t d);  ///< slot d of the opened sheet is a vertex

constexpr double explicit_safety = 0.9;  ///< of an explicit step: the limit is that of the sheet at rest

bool at_rest(const Scene& scene);      ///< in equilibrium
bool is_explicit(const Scene& scene);  ///< symplectic Euler
/// Steps until the duration is over, the last one whole; and when they end, s. In equilibrium: 1, and its step.
double steps_of(const Scene& scene);
double end_of(const Scene& scene);
/// Ends at the same time, in so many steps or one more. \pre not in equilibrium
void set_steps(Scene& scene, double steps);

struct SceneRun {
  Verdict verdict = Verdict::ok;  ///< of the steps, or the status of the first cut that is not ok
  std::string reason;
  // Largest distances at the end, m; NaN where a verdict ended the run early.
  double deflection = std::numeric_limits<double>::quiet_NaN();  ///< of a vertex from its rest position
  double gape = std::numeric_limits<double>::quiet_NaN();        ///< of vertices that were one before the cuts
  // Of pieces that nothing holds, while others are held: they fall, and count in neither of the two.
  int free_pieces = 0;
  double fall = std::numeric_limits<double>::quiet_NaN();  ///< deflection of theirs; NaN where there is none
  double ms_per_second = 0;  ///< of steps and cuts by the clock, for a simulated second; in equilibrium: of the solve
  int steps = 0;
  double processor_s = 0;              ///< of the process, with watching it
  std::unique_ptr<Simulation> motion;  ///< as it ended; none where it could not be started
  bool ended() const { return deflection >= 0; }
};

/// Per slot of a deformed vertex of `end`: it is of a piece that no pin of the scene holds, while there are held ones.
std::vector<bool> on_free_pieces(const Scene& scene, const Sheet& end);

/// Reads the largest distances off the end of a run, without vertices that are `free`.
void measure(SceneRun& run, const Sheet& end, const std::vector<bool>& free);

/// Runs it watched. What can't be started, or misses the sheet with a pick, has the verdict `refused`.
/// \param time_limit  s of processor time
SceneRun run_to_end(const Scene& scene, CuttingMethod& method, const CutOptions& options, double time_limit);

/// Milliseconds of processor time of the steps and cuts alone, for a simulated second; in equilibrium: of the solve.
/// \pre run_to_end() ended
double processor_ms_per_second(const Scene& scene, CuttingMethod& method, const CutOptions& options);

}  // namespace cutbench
