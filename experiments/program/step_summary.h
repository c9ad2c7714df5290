// What the steps of a simulation cost, as `cutbench simulate` prints it and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "harness/simulation/step_log.h"

namespace cutbench {

/// Milliseconds of each phase over all steps (median, worst), the steps with a cut by themselves, iterations, and the
/// real-time factor: simulated over computed seconds. A residual is null where no step solved a system.
/// \param seconds  simulated \pre `steps` is not empty
nlohmann::ordered_json summary_of(std::span<const LoggedStep> steps, double seconds);
/// A table with a row for each step, as CSV: milliseconds of the cuts before it and of its phases, its iterations and
/// relative residual, empty where it solved no system. \param step  s
std::string table_of(const std::vector<LoggedStep>& steps, double step);
void print_summary(const nlohmann::ordered_json& summary);

}  // namespace cutbench
