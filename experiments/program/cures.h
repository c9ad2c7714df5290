// What to try first where a simulation did not go well.
#pragma once

#include <string>

#include "harness/simulation/scene.h"
#include "harness/simulation/simulation.h"

namespace cutbench {

/// In one line, with numbers of this run; empty: nothing is wrong. docs/how-to/my_run_says.md has more.
std::string cure_of(const Scene& scene, const SimulationOutcome& outcome, const StepLimits& limits);

}  // namespace cutbench
