// An experiment file: which methods cut what, and which of four kinds of study that is. Each kind has keys of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/programs/program.h"
#include "harness/simulation/scene.h"
#include "harness/study/sweep.h"

namespace cutbench {

/// Cuts of seeded families, measured: times, shapes, eigenvalues, the same cuts in a running scene.
struct CutStudy {
  std::vector<std::string> cut_families;
  int cases = 1;             ///< of each sheet, resolution and cut family
  bool own_cuts = false;     ///< each sheet and size has cuts of its own, instead of the same as all others
  int repetitions = 1;       ///< of each cut, warm
  bool times = true;         ///< false: no times are recorded, and all cores may work
  bool cold = false;         ///< cut once more with cold caches
  bool quality = true;       ///< shapes, forced zones; the oracle judges every case either way
  int eigenvalue_cases = 0;  ///< in so many cases the largest eigenvalue (harness/fem) is computed, too
  bool every_edge = false;   ///< time the search over every edge too, as the paper words it
  /// Each cut is made once more inside this running scene, after its first step that ends at `cut_time` or later. Sheet
  /// and resolution are the experiment's.
  std::optional<Scene> scene;
  double cut_time = 0;  ///< s
  int scene_cases = 0;  ///< only so many of the cases are cut in the scene
};

/// Problems with a known answer (harness/problems/common/problem.h): every cut sheet is loaded, solved and compared
/// with it. Its cases are the members of a problem's ensemble.
struct AccuracyStudy {
  std::vector<std::string> problems;
  std::vector<std::string> direct;           ///< solvers that run until they converge
  std::vector<std::string> preconditioners;  ///< iterative solvers that stop after each number of `iterations`
  std::vector<int> iterations;
  std::vector<std::pair<int, int>> members;            ///< (resolution, number of members of each problem's ensemble)
  std::vector<std::pair<int, int>> members_nonlinear;  ///< the same for problems that take no budgets; may be 0
  bool tip_functions = false;  ///< solve directly with functions for the tips (harness/fem/tips/tip_functions.h), too
  bool reference = true;       ///< solve on a mesh fitted to the cut too; excess errors are measured against it
  bool graded_reference = false;  ///< and on one graded at tips, where there are any: a row beside the methods'
};

/// Adversarial cuts (harness/cases/adversarial.h), counted instead of measured.
struct RobustnessStudy {
  int cases = 1;                                  ///< of each sheet and resolution, and of each of `mesh_files`
  std::vector<std::filesystem::path> mesh_files;  ///< sheets besides the families
  double time_limit_s = 10;                       ///< processor time of a case, its judgement included
  bool cross_check = false;                       ///< CGAL's triangulation of the whole sheet cuts, too
};

/// Sweeps to where the methods fail (harness/study/sweep.h).
struct StabilityStudy {
  int cases = 1000000;  ///< the most of a point, whose sweep says how many
  std::vector<Sweep> sweeps;
  double time_limit_s = 20;  ///< processor time of a point
};

struct Experiment {
  /// A method and the values of its parameter to run it with; none: its default.
  struct Entry {
    std::string method;
    std::vector<double> parameter_values;
  };
  struct SizedSheet {
    std::string family;
    int resolution;
  };

  std::string stem;  ///< of the file: names the results folder and the plot
  /// What was asked for, as a text that differs where rows could: the file without its comments and spaces, the files
  /// that it names (those of programs apart), and the options of the command line.
  std::string asked;
  std::string claim;  ///< that the experiment tests
  std::vector<std::string> sheets;
  std::vector<int> resolutions;           ///< triangles of the uncut sheet, 2 n^2
  std::vector<Entry> methods;             ///< empty: the file says "all", and the caller fills them in
  std::vector<ProgramSettings> programs;  ///< methods that are programs; `methods` names them, too
  std::uint64_t seed = 1;                 ///< for development; published figures use --seed commit
  double chord_tolerance = 0.05;          ///< in mean rest edges
  std::variant<CutStudy, AccuracyStudy, RobustnessStudy, StabilityStudy> study;

  std::vector<SizedSheet> sized_sheets() const;  ///< each sheet in all resolutions, then the next one
  bool records_times() const;                    ///< then only one process may work, on one core
};

/// The methods with their parameters and programs, as a text that differs where their rows could.
std::string identity_of_methods(const Experiment& experiment);

/// Throws InputError: unreadable, not TOML, unknown or missing keys (with the nearest known one), keys of another kind
/// of study, values out of range.
Experiment read_experiment(const std::filesystem::path& file);

}  // namespace cutbench
