// What the updates of a running simulation save: the same made anew after a cut, timed.
#pragma once

#include <vector>

#include "harness/records/metrics.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// \param pins   of the scene (pins_of())
/// \param sheet  after the cut, with its vertices where they are (Simulation::tried_sheet())
RebuildTimes time_rebuild(const Scene& scene, const std::vector<Pin>& pins, const Sheet& sheet);

}  // namespace cutbench
