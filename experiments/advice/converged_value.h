// The converged value of a scene's quantity: that of ever smaller triangles and steps, extrapolated (Richardson 1911)
// from runs finer than the scene. For `cutbench recommend`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "experiments/advice/scene_trial.h"

namespace cutbench {

/// Of sheets that runs are made with, beside the scene's own.
constexpr int most_triangles = 12800;

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

class ConvergedValue {
 public:
  /// From runs of half the scene's edges and steps; of the scene's own edges where half of them take over
  /// `most_triangles`. Explicit steps are half as long as the cut sheet allows. \param time_limit  of a run, s of
  /// processor time
  ConvergedValue(const Scene& scene, std::string method, SheetLevels& sheets, const SceneTrials& runs,
                 double time_limit);

  const Converged& get() const { return result_; }

  /// Halves the edges or the steps, those that matter more. False, and the value stays as it was, where that takes over
  /// `most_work` times the scene's triangles x steps, or where a run does not end as `ok`, now or before.
  bool refine(double most_work);

 private:
  Choice choice_of(double fineness, int steps) const;
  double value_of(double fineness, int steps);
  bool extrapolate(double fineness, int steps);
  bool has_sheets(double fineness);
  int stable_steps(double fineness);

  const Scene& scene_;
  std::string method_;
  SheetLevels& sheets_;
  SceneTrials trials_;
  double time_limit_;
  bool at_rest_;
  double fineness_;     // of the finest run: the scene's edges over its own
  int steps_;           // of the finest run
  double own_steps_;    // that a run of the scene's own triangles needs
  std::string failed_;  // why a run has no value
  Converged result_;
};

}  // namespace cutbench
