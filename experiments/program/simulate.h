// `cutbench simulate`: runs one scene with its cuts by one method, and says what happened.
#pragma once

#include <string>

#include "harness/cut/cut.h"
#include "harness/simulation/scene.h"

namespace cutbench {

struct SimulateOptions {
  std::string method;     ///< as a caption names it: with its parameter
  std::string command;    ///< as given
  std::string out;        ///< the sheet as it ends up; empty: not written
  std::string frames;     ///< folder of the time series (harness/files/frame_writer.h), with simulation.json and
                          ///< energy.csv (harness/simulation/energy_budget.h); empty: none
  std::string animation;  ///< WebP of the same frames; empty: none
  int every = 8;          ///< steps from frame to frame
  std::string report;     ///< JSON file of what the steps cost; empty: not written
  std::string steps;      ///< CSV file of what each step cost; empty: not written
  double time_limit = 0;  ///< s, of processor time; 0: none
  CutOptions cut;
};

/// Prints a line of energies ten times, what the cuts did, and what the steps cost. False where a cut or a step failed.
bool simulate(const Scene& scene, CuttingMethod& method, const SimulateOptions& options);

}  // namespace cutbench
