// One point of the stability sweeps: the cut by itself, judged and measured, and then the motion of a scene that begins
// with it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

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

/// What is measured, in the order of the records' columns.
struct PointMeasure {
  enum Kind {
    triangles,
    vertices_added,
    ar_max_cut,
    altitude_min_h_cut,
    incision_error_h,
    geometry_us,
    eigenvalue_ratio,
    explicit_step_ratio,
    steps,
    cut_update_us,
    first_step_us,
    step_us,
    iterations,
    residual,
    energy_gain,
    drift_h
  };
};
constexpr std::array<const char*, 16> measure_names{"triangles",
                                                    "vertices_added",
                                                    "ar_max_cut",
                                                    "altitude_min_h_cut",
                                                    "incision_error_h",
                                                    "geometry_us",
                                                    "eigenvalue_ratio",
                                                    "explicit_step_ratio",
                                                    "steps",
                                                    "cut_update_us",
                                                    "first_step_us",
                                                    "step_us",
                                                    "iterations",
                                                    "residual",
                                                    "energy_gain",
                                                    "drift_h"};

/// In memory that is shared between processes, so that what was found before a crash is not lost.
struct TrialResult {
  std::array<char, 24> status{}, verdict{};
  std::array<char, 200> reason{};
  std::array<double, measure_names.size()> measure = filled_with_nan();  ///< NaN: not measured

  static constexpr std::array<double, measure_names.size()> filled_with_nan() {
    std::array<double, measure_names.size()> all{};
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
