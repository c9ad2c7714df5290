// The subcommands of the program, each in a file of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace cutbench {

/// What the shell sees. cutbench.cpp returns `fell_short` for an OutputError too, and `bad_input` for an InputError.
enum Exit { done = 0, fell_short = 1, bad_input = 2 };

struct Command {
  CLI::App* options;  ///< of the subcommand; owned by the app
  /// Does the work once the options are parsed. `command_line`: the whole of it, for records.
  std::function<Exit(const std::string& command_line)> run;
};

/// Each adds its subcommand to `app`.
Command add_cut(CLI::App& app);
Command add_score(CLI::App& app);
Command add_simulate(CLI::App& app);
Command add_ablate(CLI::App& app);
Command add_recommend(CLI::App& app);
Command add_run(CLI::App& app);
Command add_reduce(CLI::App& app);
Command add_merge(CLI::App& app);
Command add_missing(CLI::App& app);
Command add_columns(CLI::App& app);
Command add_compare(CLI::App& app);

}  // namespace cutbench
