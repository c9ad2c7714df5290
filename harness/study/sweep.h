// A sweep of the stability sweeps: points that differ in a few settings, such as how far a cut passes a vertex, or the
// step and the solver of the motion after it. A setting with several values is an axis; every constraint_matrix is a
// point.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/scenes/toml_reader.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// What is tried at a point: a cut, judged by itself, and then the scene with this cut before its first step.
struct SweepPoint {
  std::string cut = "curved";  ///< of placed_cuts() (harness/study/stability/placed_cuts.h) or cut_families()
  double place = 0;            ///< of a placed cut: a distance in h, an angle in degrees, or a number of cuts
  std::string pose = "flat";   ///< of poses(): how the sheet starts
  double pose_amount = 0;      ///< degrees of `rolled`; the factor of `stretched`
  /// Positive: symplectic Euler, with this share of the largest stable step of the uncut sheet. Zero: as the scene
  /// says.
  double step_share = 0;
  Scene scene;
  bool eigenvalue = false;  ///< measured here: the first of the sweep's points with this cut and material
};

/// A setting that a sweep may vary: its name in the experiment and in the records, and where its value goes.
struct SweepSetting {
  const char* name;
  std::string (*get)(const SweepPoint&);
  /// Throws InputError, beginning with the reader's `where`. \pre the reader's table has `name`.
  void (*set)(const TomlReader&, SweepPoint&);
};
/// In the order of the records' columns.
std::span<const SweepSetting> sweep_settings();
/// `flat`; `rolled`: round a cylinder, by the angle `pose_amount`; `stretched`: x times `pose_amount`, which turns the
/// triangles of a plane scene over where it is negative.
std::span<const char* const> poses();

struct Sweep {
  std::string name;
  std::filesystem::path scene_file;
  std::vector<std::string> sheets, methods;  ///< of the experiment's; empty: all
  std::vector<int> resolutions;              ///< likewise
  int cases = 1;                             ///< seeded places of each point
  int steps = 0;                             ///< of the motion after the cut; 0: the cut alone
  bool drift = false;                        ///< measured, against the same motion solved by `cholmod`
  std::vector<SweepPoint> points;  ///< every constraint_matrix of the settings' values, the last varies fastest
};

/// As read_scene(). Refuses an `active_radius`: it is that round the scene's own cuts.
Scene read_scene_for_experiment(const std::filesystem::path& file);

/// Reads [[sweeps]]: name, scene (relative to the experiment's folder), sheets, methods, resolutions, cases, steps,
/// eigenvalue, drift, and settings, each a value or a list of values. Throws InputError.
std::vector<Sweep> read_sweeps(const TomlReader& experiment, const std::filesystem::path& folder);

}  // namespace cutbench
