// The program `cutbench` as a library: a program with methods of its own is this, called with their rows.
#pragma once

#include <vector>

#include "harness/cut/method_row.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// Parses the command line and does what it says. `more_methods`: beside those of the table, in all lists, experiments
/// and tests of names. `scene`: what `ablate` and `recommend` take instead of the file that they are given. Returns
/// what the shell is to see (docs/reference/commands.md, exit codes).
int command_line(int argc, char** argv, const std::vector<MethodRow>& more_methods = {}, const Scene* scene = nullptr);

}  // namespace cutbench
