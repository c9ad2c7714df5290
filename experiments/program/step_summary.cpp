#include "experiments/program/step_summary.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Median and worst of something over steps, us to ms. The median of an even number is the mean of the middle two.
nlohmann::ordered_json spread(std::span<const LoggedStep> steps,
                              const std::function<double(const LoggedStep&)>& microseconds) {
  std::vector<double> values;
  for (const LoggedStep& step : steps) values.push_back(microseconds(step) / 1000);
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {{"median", (values[(n - 1) / 2] + values[n / 2]) / 2}, {"worst", values.back()}};
}

nlohmann::ordered_json phases_of(std::span<const LoggedStep> steps) {
  return {{"rotate", spread(steps, [](const LoggedStep& s) { return s.step.time_us.rotate; })},
          {"assemble", spread(steps, [](const LoggedStep& s) { return s.step.time_us.assemble; })},
          {"setup", spread(steps, [](const LoggedStep& s) { return s.step.time_us.setup; })},
          {"solve", spread(steps, [](const LoggedStep& s) { return s.step.time_us.solve; })},
          {"total", spread(steps, [](const LoggedStep& s) { return s.total_us(); })}};
}

}  // namespace

nlohmann::ordered_json summary_of(std::span<const LoggedStep> steps, double seconds) {
  std::vector<LoggedStep> with_cut;
  double computed_us = 0, residual = 0;
  bool solved = false;
  long iterations = 0, worst = 0, fallbacks = 0;
  for (const LoggedStep& s : steps) {
    if (s.has_cut) with_cut.push_back(s);
    computed_us += s.total_us();
    iterations += s.step.iterations;
    fallbacks += s.step.fallbacks;
    worst = std::max(worst, static_cast<long>(s.step.iterations));
    residual = std::max(residual, s.step.residual);
    solved |= s.step.newton > 0;
  }
  nlohmann::ordered_json summary{{"steps", steps.size()},
                                 {"simulated_s", seconds},
                                 {"computed_s", 1e-6 * computed_us},
                                 {"real_time_factor", computed_us > 0 ? seconds / (1e-6 * computed_us) : 0},
                                 {"step_ms", phases_of(steps)}};
  summary["iterations"] = {{"mean", to_double(iterations) / to_double(steps.size())},
                           {"worst", worst},
                           {"largest_residual", solved ? nlohmann::ordered_json(residual) : nullptr},
                           {"fallbacks", fallbacks}};
  nlohmann::ordered_json cuts{{"steps", with_cut.size()}};
  if (!with_cut.empty()) {
    cuts["cut_ms"] = spread(with_cut, [](const LoggedStep& s) { return s.geometry_us; });
    cuts["update_ms"] = spread(with_cut, [](const LoggedStep& s) { return s.update_us; });
    cuts["bending_ms"] = spread(with_cut, [](const LoggedStep& s) { return s.bending_us; });
    cuts["step_ms"] = phases_of(with_cut);
  }
  summary["with_cut"] = cuts;
  return summary;
}

std::string table_of(const std::vector<LoggedStep>& steps, double step) {
  std::string table =
      "time_s,has_cut,cut_ms,update_ms,bending_ms,rotate_ms,assemble_ms,setup_ms,solve_ms,total_ms,iterations,"
      "residual\n";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const LoggedStep& s = steps[i];
    const StepTimes& us = s.step.time_us;
    char row[256], residual[32];
    std::snprintf(residual, sizeof residual, "%.3g", s.step.residual);
    std::snprintf(row, sizeof row, "%.6g,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%d,%s\n", step * to_double(i + 1),
                  s.has_cut, s.geometry_us / 1000, s.update_us / 1000, s.bending_us / 1000, us.rotate / 1000,
                  us.assemble / 1000, us.setup / 1000, us.solve / 1000, s.total_us() / 1000, s.step.iterations,
                  s.step.newton > 0 ? residual : "");
    table += row;
  }
  return table;
}

void print_summary(const nlohmann::ordered_json& summary) {
  const auto row = [](const std::string& name, const nlohmann::ordered_json& ms) {
    std::printf("  %-9s %9.3f %9.3f\n", name.c_str(), ms["median"].get<double>(), ms["worst"].get<double>());
  };
  std::printf(
      "%zu steps; %.3g s simulated in %.3g s by the wall clock: real-time factor %.3g, the one over the other\n",
      summary["steps"].get<std::size_t>(), summary["simulated_s"].get<double>(), summary["computed_s"].get<double>(),
      summary["real_time_factor"].get<double>());
  std::printf("wall ms a step median     worst\n");
  for (const auto& [phase, ms] : summary["step_ms"].items()) row(phase, ms);
  const auto& cuts = summary["with_cut"];
  if (cuts["steps"].get<int>() > 0) {
    std::printf("%d steps with a cut, ms\n", cuts["steps"].get<int>());
    for (const char* phase : {"cut", "update", "bending"}) row(phase, cuts[std::string(phase) + "_ms"]);
    row("total", cuts["step_ms"]["total"]);
  }
  const auto& solver = summary["iterations"];
  if (solver["worst"].get<int>() > 0)
    std::printf("iterations a step: %.1f in the mean, %d at most\n", solver["mean"].get<double>(),
                solver["worst"].get<int>());
  if (!solver["largest_residual"].is_null())
    std::printf("largest residual of a solve: %.2g\n", solver["largest_residual"].get<double>());
  if (const int n = solver["fallbacks"].get<int>(); n > 0)
    std::printf("in %d solves the preconditioner had given up, and the next took its place\n", n);
}

}  // namespace cutbench
