// `cutbench recommend`: the cheapest way to simulate a scene whose error is small enough.
//
// The error is that of one number, the largest gape or deflection at the end, against its converged value
// (converged_value.h). That value is known up to a margin: its spread times a quantile that was measured on scenes
// whose converged value is known better (split conformal prediction with a normalised score: Papadopoulos, Gammerman,
// Vovk 2008; Lei et al. 2018, J. Am. Stat. Assoc. 113). Each candidate is then run whole. Its error lies in an interval
// that follows from the margin alone, so where the margin holds, all intervals hold: to choose the best of many does no
// harm. Candidates whose interval holds the error asked for are undecided. While one of them is much cheaper than the
// best, the converged value is refined. The quantile is that of values that were not refined so; that it holds for
// those that were is what experiments/recommend_validation tests.
//
// Scenes that the calibration has not seen get an answer, too, by a margin that is `guessed_margin` times as wide. It
// is a guess: no share of scenes is known for it.
#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/advice/converged_value.h"
#include "experiments/advice/scene_trial.h"

namespace cutbench {

/// Scenes whose converged value is known better: what they have in common, and their scores, |better value - converged
/// value| / spread. A scene beyond them is unknown.
struct Calibration {
  std::string file;
  double level = 0;     ///< share of scenes in which the margin holds
  double quantile = 0;  ///< margin / spread: the least score that this share of n + 1 scenes does not exceed
  std::vector<std::string> integrators;
  double least_resolution = 0, most_resolution = 0, least_steps = 0, most_steps = 0;
  double most_spread = 0;  ///< over the value
};

constexpr double guessed_margin = 3;  ///< over the calibrated one

/// \param file  empty: the one that the program was built with
/// \throw InputError
Calibration read_calibration(const std::filesystem::path& file);

struct RecommendOptions {
  Quantity quantity = Quantity::gape;
  double max_error = 0;                                     ///< relative
  double max_ms = std::numeric_limits<double>::infinity();  ///< for a simulated second
  std::vector<std::string> methods, solvers;                ///< the first method makes the converged value
  CutOptions cut = {};
  double time_limit = 600;  ///< of a run, s of processor time
  bool everything = false;  ///< runs and times also what can no longer be the cheapest; the value is not refined
};

struct Recommendation {
  Converged converged;
  double margin = std::numeric_limits<double>::quiet_NaN();  ///< m
  /// The converged value was refined beyond those of the calibration, because candidates were undecided.
  bool refined_to_decide = false;
  /// In the order in which they were run; by the next solvers only where the first may be good enough.
  std::vector<SceneTrial> trials = {};
  std::optional<std::size_t> chosen = {};
  std::string unknown = {};  ///< why none is chosen: all reasons, where nothing was run
  /// How the scene is not like those of the calibration. Not empty: all is a guess.
  std::vector<std::string> beyond = {};
  std::vector<std::string> notes = {};  ///< what candidates there are not, and what does not count
};

/// Refined until the spread is a fifth of the error asked for, or the triangles x steps are 64 times the scene's.
Converged converge(const Scene& scene, const RecommendOptions& options);
Recommendation recommend(const Scene& scene, const RecommendOptions& options, const Calibration& calibration);

void print_converged(const Converged& converged, Quantity quantity);
void print_recommendation(const Recommendation& result, const RecommendOptions& options,
                          const Calibration& calibration);
nlohmann::ordered_json json_of(const Converged& converged);
nlohmann::ordered_json json_of(const Recommendation& result);

}  // namespace cutbench
