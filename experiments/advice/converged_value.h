// The converged value of a scene's quantity: that of ever smaller triangles and steps, extrapolated (Richardson 1911)
// from runs finer than the scene. For `cutbench recommend`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "experiments/advice/scene_trial.h"

namespace cutbench {

/// Extrapolated from a run, one of edges twice as long, and one of steps twice as long.
struct Converged {
  std::vector<SceneTrial> runs;
  Choice finest = {};                                       ///< of the runs that the value comes from
  double value = std::numeric_limits<double>::quiet_NaN();  ///< m
  // What the extrapolation adds, m.
  double from_mesh = 0, from_step = 0;
  double spread = std::numeric_limits<double>::quiet_NaN();  ///< m: their absolute values
  std::string missing;                                       ///< why there is no value
};

/// \pre The sheet is not read from a file: that has no other resolutions.
class ConvergedValue {
 public:
  /// From runs of half the scene's edges and steps. \param time_limit  of a run, s of processor time
  ConvergedValue(const Scene& scene, std::string method, const SceneTrials& runs, double time_limit);

  const Converged& get() const { return result_; }

  /// Halves the edges or the steps, those that matter more. False, and the value stays as it was, where that takes over
  /// `most_work` times the scene's triangles x steps, or where a run does not end as `ok`, now or before.
  bool refine(double most_work);

 private:
  Choice choice_of(int side, int steps) const;
  double value_of(int side, int steps);
  bool extrapolate(int side, int steps);

  const Scene& scene_;
  std::string method_;
  SceneTrials trials_;
  double time_limit_;
  bool at_rest_;
  int side_, steps_;    // squares a side, and steps, of the finest run
  std::string failed_;  // why a run has no value
  Converged result_;
};

}  // namespace cutbench
