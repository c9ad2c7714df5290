// One point of the stability sweeps: the cut by itself, judged and measured, and then the motion of a scene that begins
// with it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/mesh/constraints.h"
#include "harness/study/sweep.h"
#include "harness/study/variant.h"

namespace cutbench {

/// A point with all that it depends on.
struct Trial {
  const Sweep* sweep;
  const SweepPoint* point;
  const Variant* variant;
  std::string sheet;  ///< of sheet_families()
  int resolution;     ///< triangles of the uncut sheet
  std::size_t index;  ///< of the case
  std::uint64_t seed;
  CutOptions options;
  double uncut_step_s;  ///< explicit_step_limit() of the uncut sheet, bending included
};

/// The names of what is measured at a point: the columns of the table (harness/records/stability_metrics.cpp) behind
/// `reason`.
const std::vector<std::string>& point_measures();
/// Memory for so many of them; point_measures() throws std::logic_error where there are more.
constexpr std::size_t most_point_measures = 24;

/// In memory that is shared between processes, so that what was found before a crash is not lost.
struct TrialResult {
  std::array<char, 24> status{}, verdict{};
  std::array<char, 200> reason{};
  /// In the order of point_measures(). NaN: not measured.
  std::array<double, most_point_measures> measure = filled_with_nan();

  static constexpr std::array<double, most_point_measures> filled_with_nan() {
    std::array<double, most_point_measures> all{};
    all.fill(std::numeric_limits<double>::quiet_NaN());
    return all;
  }
};

/// The scene of a trial: its sheet, posed, and its integrator.
Scene scene_of(const Trial& trial);

/// The largest stable explicit step of a sheet made of the scene's material, s, bending included; NaN where its mass is
/// not positive.
double explicit_step_of(const Scene& scene, const Sheet& sheet, const Constraints& constraints = {});

/// The verdict is that of the cut where it is not ok, else that of the motion: `refused`, `failed`, the oracle's, or a
/// SimulationOutcome. While it is under way the reason says what it is at.
void try_point(const Trial& trial, TrialResult& result);

}  // namespace cutbench
