// The subcommands of the program, each in a file of its own.
#pragma once

#include <functional>
#include <string>

#include "experiments/program/options.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// What the shell sees. cutbench.cpp returns `fell_short` for an OutputError too, and `bad_input` for an InputError.
enum Exit { done = 0, fell_short = 1, bad_input = 2 };

struct Command {
  Options options;  ///< of the subcommand
  /// Does the work once the options are parsed. `command_line`: the whole of it, for records.
  std::function<Exit(const std::string& command_line)> run;
};

/// Each adds its subcommand to `app`. \param given  a scene instead of the file of one
Command add_cut(Options& app);
Command add_score(Options& app);
Command add_simulate(Options& app);
Command add_ablate(Options& app, const Scene* given);
Command add_recommend(Options& app, const Scene* given);
Command add_run(Options& app);
Command add_reduce(Options& app);
Command add_merge(Options& app);
Command add_missing(Options& app);
Command add_columns(Options& app);
Command add_compare(Options& app);

}  // namespace cutbench
