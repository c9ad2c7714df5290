// `cutbench simulate`: runs one scene with its cuts by one method, and says what happened.
#pragma once

#include <string>

#include "harness/cut/cut.h"
#include "harness/run/scene.h"

namespace cutbench {

/// Prints a line of energies ten times; writes the sheet as it ends up where `out` is not empty. False where a cut or a
/// step failed.
bool simulate(const Scene& scene, CuttingMethod& method, const CutOptions& options, const std::string& out);

}  // namespace cutbench
