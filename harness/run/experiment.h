// An experiment file: which methods cut what, how often, and what is measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/run/scene.h"

namespace cutbench {

struct Experiment {
  /// A method and the values of its knob to run it with; none: its default.
  struct Entry {
    std::string method;
    std::vector<double> knob_values;
  };

  std::string stem;   ///< of the file: names the results folder and the plot
  std::string claim;  ///< what is put to the test
  std::vector<std::string> sheets, cut_families;
  std::vector<int> resolutions;  ///< triangles of the uncut sheet, 2 n^2
  std::vector<Entry> methods;
  std::uint64_t seed = 1;         ///< for development; published figures use --seed commit
  int cases = 1;                  ///< per sheet, resolution and cut family
  int repetitions = 1;            ///< of each cut, warm
  bool cold = false;              ///< and once more with cold caches
  bool quality = true;            ///< shapes, forced zones; the oracle judges every case either way
  bool every_edge = false;        ///< time the paper's wording taken literally, too
  double chord_tolerance = 0.05;  ///< in mean rest edges
  /// Each cut is made once more inside this running scene, after its first step that ends at `cut_time` or later. Sheet
  /// and resolution are the experiment's.
  std::optional<Scene> scene;
  std::string scene_text;  ///< of its file
  double cut_time = 0;     ///< s
  int scene_cases = 0;     ///< so many of the cuts only
};

/// Throws InputError: unreadable, not TOML, unknown or missing keys (with the nearest known one), values out of range.
Experiment read_experiment(const std::filesystem::path& file);

/// n of the n x n squares that make `triangles`; throws InputError unless there is one.
int squares_per_side(int triangles);

}  // namespace cutbench
