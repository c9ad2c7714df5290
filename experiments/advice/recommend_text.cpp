// What `cutbench recommend` prints, and its report.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "experiments/advice/recommend.h"

namespace cutbench {

namespace {

constexpr std::size_t most_rows = 10;  // of the table

const char* name_of(Quantity quantity) { return quantity == Quantity::gape ? "gape" : "deflection"; }

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
}

nlohmann::ordered_json json_of(const std::vector<SceneTrial>& trials) {
  auto array = nlohmann::ordered_json::array();
  for (const SceneTrial& trial : trials)
    array.push_back({{"method", trial.choice.method},
                     {"solver", trial.choice.solver},
                     {"resolution", trial.choice.resolution},
                     {"steps", trial.choice.steps},
                     {"verdict", name_of(trial.verdict)},
                     {"reason", trial.reason},
                     {"value_m", finite_or_null(trial.value)},
                     {"error", finite_or_null(trial.error)},
                     {"error_low", finite_or_null(std::isfinite(trial.error) ? trial.low : trial.error)},
                     {"error_high", finite_or_null(trial.high)},
                     {"ms_per_s", finite_or_null(trial.ms_per_second)}});
  return array;
}

void print_row(const SceneTrial& trial) {
  std::printf("%-20s %-18s %9d %7d %9.3g %8.3g %8.3g %9.3g\n", trial.choice.method.c_str(), trial.choice.solver.c_str(),
              trial.choice.resolution, trial.choice.steps, 100 * trial.error, 100 * trial.low, 100 * trial.high,
              trial.ms_per_second);
}

}  // namespace

void print_converged(const Converged& converged, Quantity quantity) {
  if (!converged.missing.empty()) {
    std::printf("converged %s: none: %s\n", name_of(quantity), converged.missing.c_str());
    return;
  }
  std::printf("converged %s: %.6g m, extrapolated by %.2g m from %d triangles and %d steps\n", name_of(quantity),
              converged.value, converged.spread, converged.finest.resolution, converged.finest.steps);
}

void print_recommendation(const Recommendation& result, const RecommendOptions& options,
                          const Calibration& calibration) {
  if (!result.converged.runs.empty()) print_converged(result.converged, options.quantity);
  if (std::isfinite(result.margin))
    std::printf(result.beyond.empty() ? "known to %.2g m in %g %% of scenes like those of %s%s\n"
                                      : "known to %.2g m by a guess: %g %% was measured on other scenes, %s%s\n",
                result.margin, 100 * calibration.level, calibration.file.c_str(),
                result.refined_to_decide ? "; refined further than those" : "");
  for (const std::string& reason : result.beyond) std::printf("a guess: %s\n", reason.c_str());
  for (const std::string& note : result.notes) std::printf("note: %s\n", note.c_str());
  std::vector<SceneTrial> good;
  for (const SceneTrial& trial : result.trials)
    if (trial.verdict == Verdict::ok && trial.high <= options.max_error) good.push_back(trial);
  std::sort(good.begin(), good.end(),
            [](const SceneTrial& a, const SceneTrial& b) { return a.ms_per_second < b.ms_per_second; });
  if (!result.trials.empty())
    std::printf("%zu of %zu runs err by %g %% or less for certain\n\n%-20s %-18s %9s %7s %9s %8s %8s %9s\n",
                good.size(), result.trials.size(), 100 * options.max_error, "method", "solver", "triangles", "steps",
                "error %", "from", "to", "ms/s");
  for (std::size_t i = 0; i < std::min(good.size(), most_rows); ++i) print_row(good[i]);
  if (good.size() > most_rows) std::printf("... and %zu more\n", good.size() - most_rows);
  if (!result.chosen) {
    std::printf("\nunknown: %s\n", result.unknown.c_str());
    return;
  }
  const SceneTrial& best = result.trials[*result.chosen];
  std::printf("\n%stake %s, solver %s, %d triangles, %d steps: error %.2g %% (%.2g to %.2g), %.3g ms for a second\n",
              result.beyond.empty() ? "" : "a guess: ", best.choice.method.c_str(), best.choice.solver.c_str(),
              best.choice.resolution, best.choice.steps, 100 * best.error, 100 * best.low, 100 * best.high,
              best.ms_per_second);
}

nlohmann::ordered_json json_of(const Converged& converged) {
  return {{"value_m", finite_or_null(converged.value)},
          {"spread_m", finite_or_null(converged.spread)},
          {"resolution", converged.finest.resolution},
          {"steps", converged.finest.steps},
          {"missing", converged.missing},
          {"runs", json_of(converged.runs)}};
}

nlohmann::ordered_json json_of(const Recommendation& result) {
  return {{"converged", json_of(result.converged)},
          {"margin_m", finite_or_null(result.margin)},
          {"refined_to_decide", result.refined_to_decide},
          {"chosen", result.chosen ? nlohmann::ordered_json(*result.chosen) : nullptr},
          {"unknown", result.unknown},
          {"beyond_calibration", result.beyond},
          {"notes", result.notes},
          {"trials", json_of(result.trials)}};
}

}  // namespace cutbench
