// One way to simulate a scene, tried: for `cutbench recommend`.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "experiments/advice/sheet_levels.h"
#include "harness/cut/cut.h"
#include "harness/simulation/scene.h"

namespace cutbench {

enum class Quantity { gape, deflection };  ///< the largest at the end, m: experiments/advice/scene_run.h

/// How a scene may be simulated.
struct Choice {
  std::string method, solver;
  int resolution = 0, steps = 0;
  bool operator==(const Choice&) const = default;
};

struct SceneTrial {
  Choice choice;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< of the quantity, m
  // Relative: |value - converged value| / converged value, and between what, given the margin.
  double error = std::numeric_limits<double>::quiet_NaN();
  double low = 0, high = std::numeric_limits<double>::infinity();
  /// Milliseconds of processor time for a simulated second, the least of `timings` runs; NaN: not timed.
  double ms_per_second = std::numeric_limits<double>::quiet_NaN();
  int timings = 0;
  double time_limit = 0;  ///< of the run for its value, s of processor time
  int free_pieces = 0;    ///< that fall, and don't count in the value
};

/// Runs a scene as chosen. The scene and its sheets must outlive it.
class SceneTrials {
 public:
  SceneTrials(const Scene& scene, const SheetLevels& sheets, Quantity quantity, const CutOptions& cut)
      : scene_(scene), sheets_(sheets), quantity_(quantity), cut_(cut) {}

  /// Whole, for its value. \param time_limit  s of processor time
  SceneTrial run(const Choice& choice, double tolerance, double time_limit) const;
  /// Once more, for its time. \pre its verdict is `ok`
  void time(SceneTrial& trial) const;
  /// Of explicit steps: the least number that is stable once all cuts are made, with a little to spare; none where the
  /// method has no such step, or refuses a cut.
  std::optional<int> stable_steps(const std::string& method, int triangles) const;

 private:
  Scene scene_of(const Choice& choice) const;

  const Scene& scene_;
  const SheetLevels& sheets_;
  Quantity quantity_;
  CutOptions cut_;
};

}  // namespace cutbench
