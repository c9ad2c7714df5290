// An experiment file: which methods cut what, how often, and what is measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/programs/program.h"
#include "harness/simulation/scene.h"
#include "harness/study/sweep.h"

namespace cutbench {

struct Experiment {
  /// A method and the values of its parameter to run it with; none: its default.
  struct Entry {
    std::string method;
    std::vector<double> parameter_values;
  };

  /// Adversarial cuts (harness/cases/adversarial.h) instead of families, counted instead of measured.
  struct Robustness {
    std::vector<std::filesystem::path> mesh_files;  ///< sheets besides the families
    double time_limit_s = 10;                       ///< processor time of a case, its judgement included
    bool cross_check = false;                       ///< CGAL's triangulation of the whole sheet cuts, too
  };

  /// Problems with a known solution (harness/problems/common/problem.h) instead of cut families: every cut sheet is
  /// loaded, solved and compared with it.
  struct Accuracy {
    std::vector<std::string> problems;
    std::vector<std::string> direct;           ///< solvers that run until they converge
    std::vector<std::string> preconditioners;  ///< iterative solvers that stop after each number of `iterations`
    std::vector<int> iterations;
    std::vector<std::pair<int, int>> members;            ///< (resolution, number of members of each problem's ensemble)
    std::vector<std::pair<int, int>> members_nonlinear;  ///< the same for problems that take no budgets; may be 0
    bool tip_functions = false;  ///< solve directly with functions for the tips (harness/fem/tips/tip_functions.h), too
    bool reference = true;       ///< solve on a mesh fitted to the cut too; excess errors are measured against it
  };

  /// Sweeps to where the methods fail (harness/study/sweep.h) instead of cut families.
  struct Stability {
    std::vector<Sweep> sweeps;
    double time_limit_s = 20;  ///< processor time of a point
  };

  std::string stem;  ///< of the file: names the results folder and the plot
  /// What was asked for, as a text that differs where rows could: the file without its comments and spaces, the files
  /// that it names (those of programs apart), and the options of the command line.
  std::string asked;
  std::string claim;  ///< that the experiment tests
  std::vector<std::string> sheets, cut_families;
  std::vector<int> resolutions;           ///< triangles of the uncut sheet, 2 n^2
  std::vector<Entry> methods;             ///< empty: the file says "all", and the caller fills them in
  std::vector<ProgramSettings> programs;  ///< methods that are programs; `methods` names them, too
  std::uint64_t seed = 1;                 ///< for development; published figures use --seed commit
  int cases = 1;             ///< per sheet, resolution and cut family; of a robustness run per sheet and resolution; of
                             ///< the stability sweeps the most of a point
  bool own_cuts = false;     ///< each sheet and size has cuts of its own, instead of the same as all others
  int repetitions = 1;       ///< of each cut, warm
  bool times = true;         ///< false: no times are recorded, and all cores may work
  bool cold = false;         ///< cut once more with cold caches
  bool quality = true;       ///< shapes, forced zones; the oracle judges every case either way
  int eigenvalue_cases = 0;  ///< in so many cases the largest eigenvalue (harness/fem) is computed, too
  bool every_edge = false;   ///< time the search over every edge too, as the paper words it
  double chord_tolerance = 0.05;  ///< in mean rest edges
  /// Each cut is made once more inside this running scene, after its first step that ends at `cut_time` or later. Sheet
  /// and resolution are the experiment's.
  std::optional<Scene> scene;
  double cut_time = 0;  ///< s
  int scene_cases = 0;  ///< only so many of the cases are cut in the scene
  std::optional<Robustness> robustness;
  std::optional<Accuracy> accuracy;
  std::optional<Stability> stability;
};

/// The methods with their parameters and programs, as a text that differs where their rows could.
std::string identity_of_methods(const Experiment& experiment);

/// Throws InputError: unreadable, not TOML, unknown or missing keys (with the nearest known one), values out of range.
Experiment read_experiment(const std::filesystem::path& file);

}  // namespace cutbench
