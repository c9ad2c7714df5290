// What is found out of the cuts of a case beside its motion, in the sheet at rest.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/path/curve.h"
#include "harness/simulation/scene.h"

namespace cutbench::live {

/// Makes the cuts in the sheet at rest and has each judged by the oracle: the verdict, with its reason, and what the
/// result is like. \param parameter  of the method; NaN: its default
nlohmann::json judged(const Scene& scene, const std::string& method, double parameter,
                      const std::vector<Curve>& curves);

/// ms of the last curve's cut, the curves before it being made: the mean over repeats on copies, all of them warm.
nlohmann::json timed(const Scene& scene, const std::string& method, double parameter, const std::vector<Curve>& curves);

}  // namespace cutbench::live
