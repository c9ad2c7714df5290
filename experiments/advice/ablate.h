// `cutbench ablate`: what each part of a scene's model is worth: the change of the result without it, and the time
// saved.
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/simulation/scene.h"

namespace cutbench {

struct AblatedScene {
  std::string without;  ///< what is left out: a row's name
  Scene scene;
  std::string refused = {};  ///< why there is no such scene
};

/// The scene, and then the scene without one part at a time, of the parts that it has:
/// - bending
/// - the stiffness from stress
/// - Newton's iterations but the first
/// - the nonlinear strain: co-rotational instead
/// - the rotation of elements: linear strain instead
/// - the triangles: springs along their edges instead
/// - the third dimension, and bending with it
/// - the motion far from the cuts, where all cuts are known from the start (Scene::active_radius)
/// - linear solves: xpbd instead
/// - every second step
/// - three of four triangles (sheet_levels.h)
/// Of a scene in equilibrium Newton's iterations, the motion far from the cuts, linear solves and steps stay.
std::vector<AblatedScene> ablations_of(const Scene& scene);

/// Where a simulation ends, and what it took.
struct Ablation {
  std::string without;
  Verdict verdict = Verdict::ok;
  std::string reason;
  // Largest distances at the end, m; NaN where a verdict ended the run early.
  double deflection = std::numeric_limits<double>::quiet_NaN();  ///< of a vertex from its rest position
  double gape = std::numeric_limits<double>::quiet_NaN();        ///< of vertices that were one before the cuts
  double deviation = std::numeric_limits<double>::quiet_NaN();   ///< from the whole model; NaN on another sheet, too
  double ms_per_second = 0;  ///< of computing, for a simulated second; in equilibrium: of the solve
  int steps = 0;
  int free_pieces = 0;                                     ///< that fall: they count in none of the above
  double fall = std::numeric_limits<double>::quiet_NaN();  ///< m, of these
};

/// Runs them one after the other, the whole model first. What can't be started has the verdict `refused`. A run that
/// takes more than `time_limit` seconds of processor time, or ten times as long as the whole model, is `timed_out`. The
/// last row is explicit: symplectic Euler at 0.9 of the largest step that the whole model's cut sheet allows, unless
/// there is none (vertices are constrained) or the scene is in equilibrium or explicit already.
std::vector<Ablation> ablate(const Scene& scene, CuttingMethod& method, const CutOptions& options, double time_limit);

void print_ablations(const std::vector<Ablation>& rows);
nlohmann::ordered_json json_of(const std::vector<Ablation>& rows);

}  // namespace cutbench
