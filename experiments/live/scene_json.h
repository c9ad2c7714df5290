// The scene of a case, as docs/reference/browser.md describes its JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/mesh/sheet.h"
#include "harness/simulation/scene.h"

namespace cutbench::live {

/// What JSON says of a scene; what it leaves out is that of experiments/scenes/paper_table1.toml, solved by multigrid.
/// \throw InputError, nlohmann::json::exception
Scene scene_of(const nlohmann::json& json);

/// The sheet before any cut, with its pinned vertices held in rest space as in a simulation.
Sheet sheet_of(const Scene& scene);

}  // namespace cutbench::live
