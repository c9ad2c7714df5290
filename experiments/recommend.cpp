#include "experiments/recommend.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/scene_run.h"
#include "harness/base/toml_reader.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

constexpr double finest = 2, side_span = 8, steps_span = 16;  // of the candidates: times the scene's; over the coarsest
constexpr double spread_share = 0.2;  // of the error asked for: the spread of the converged value that is small enough
constexpr double most_refined = 64;   // triangles x steps of the finest run for the converged value, over the scene's
constexpr double widest = 4;  // triangles x steps over those of the first good candidate: more can't be the cheapest
constexpr double candidate_patience =
    4;                             // of a candidate's run, watching it included: times the cheapest good one so far
constexpr double near_best = 1.5;  // in cost: timed again
constexpr int more_timings = 3;
constexpr double tight = 1e-5;  // tolerance of the runs that give the converged value

Scene scene_of(Scene scene, const Choice& choice) {
  scene.resolution = choice.resolution, scene.solver.name = choice.solver;
  if (scene.integrator != Integrator::equilibrium) set_steps(scene, choice.steps);
  return scene;
}

int triangles(double side) { return 2 * static_cast<int>(side) * static_cast<int>(side); }

/// value, value / sqrt(2), ... value / span, rounded; each once, the smallest first.
std::set<int> ladder(double value, double span) {
  std::set<int> rungs;
  for (double i = 0; std::exp2(i / 2) <= 1.001 * span; ++i)
    rungs.insert(std::max(1, static_cast<int>(std::lround(value / std::exp2(i / 2)))));
  return rungs;
}

class Search {
 public:
  Search(const Scene& scene, const RecommendOptions& options) : scene_(scene), options_(options) {}

  Trial run(const Choice& choice, double tolerance, double time_limit) {
    Scene scene = scene_of(scene_, choice);
    scene.solver.tolerance = tolerance;
    const auto method = make(choice);
    const SceneRun made = run_to_end(scene, *method, options_.cut, time_limit);
    return {.choice = choice,
            .verdict = made.verdict,
            .reason = made.reason,
            .value = options_.quantity == Quantity::gape ? made.gape : made.deflection};
  }

  void time(Trial& trial) {
    const auto method = make(trial.choice);
    trial.ms_per_second =
        std::fmin(trial.ms_per_second, processor_ms_per_second(scene_of(scene_, trial.choice), *method, options_.cut));
  }

 private:
  static std::unique_ptr<CuttingMethod> make(const Choice& choice) {
    const MethodRow& row = find_method(choice.method);
    return row.make(row.knob.value);
  }

  const Scene& scene_;
  const RecommendOptions& options_;
};

/// The error lies between those for the ends of the interval of the converged value, or down to 0 where it has `value`.
void judge(Trial& trial, double converged, double margin) {
  const auto error = [&](double truth) { return std::abs(trial.value - truth) / truth; };
  const double a = error(converged - margin), b = error(converged + margin);
  trial.error = error(converged);
  trial.low = std::abs(trial.value - converged) <= margin ? 0 : std::min(a, b);
  trial.high = std::max(a, b);
}

std::string outside(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return "";
  char text[200];
  std::snprintf(text, sizeof text, "%s %.3g, and the calibration has seen %.3g to %.3g", what, value, least, most);
  return text;
}

/// Empty where the calibration has seen such scenes.
std::string beyond(const Scene& scene, const Calibration& seen) {
  const std::string integrator = name_of(integrator_names, scene.integrator);
  if (std::find(seen.integrators.begin(), seen.integrators.end(), integrator) == seen.integrators.end())
    return "the integrator is " + integrator + ", and the calibration has seen " + listed(seen.integrators);
  const std::string sheet =
      outside("the sheet's triangles are", scene.resolution, seen.least_resolution, seen.most_resolution);
  return sheet.empty() ? outside("the scene's steps are", steps_of(scene), seen.least_steps, seen.most_steps) : sheet;
}

/// Empty where there is a value, and the calibration has seen such.
std::string beyond(const Converged& converged, const Calibration& seen) {
  if (!converged.missing.empty()) return converged.missing;
  if (seen.quantile * converged.spread >= converged.value) return "the converged value may be 0, given its margin";
  return outside("the spread of the finer runs over the value is", converged.spread / converged.value, 0,
                 seen.most_spread);
}

/// Why no trial is good enough.
std::string shortfall(const std::vector<Trial>& trials, double max_error) {
  const Trial* best = nullptr;
  for (const Trial& trial : trials)
    if (trial.verdict == "ok" && (!best || trial.high < best->high)) best = &trial;
  if (!best) return "no candidate ended as ok";
  char text[200];
  if (best->low <= max_error)
    std::snprintf(text, sizeof text, "the error of the best candidate is %.3g to %.3g %%; give a finer scene",
                  100 * best->low, 100 * best->high);
  else
    std::snprintf(text, sizeof text, "the best candidate errs by %.3g %% or more; give a finer scene", 100 * best->low);
  return text;
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& file) {
  const toml::table table = parse_toml(file);
  check_keys(table, {"source", "level", "scores", "integrators", "resolutions", "steps", "most_spread"}, file.string());
  const TomlReader reader{table, file.string()};
  const auto range = [&](const char* key) {
    const auto values = reader.list<double>(key);
    if (values.size() != 2 || !(values[0] <= values[1]))
      reader.refuse(std::string("\"") + key + "\" must be [least, most]");
    return values;
  };
  const auto resolutions = range("resolutions"), steps = range("steps");
  const double level = reader.positive("level", 0);
  auto scores = reader.list<double>("scores");
  std::sort(scores.begin(), scores.end());
  const double rank = std::ceil(level * static_cast<double>(scores.size() + 1) - 1e-9);  // Lei et al. 2018, section 2.2
  if (rank > static_cast<double>(scores.size()))
    reader.refuse("a level of " + std::to_string(level) + " takes more than " + std::to_string(scores.size()) +
                  " scores");
  return {.file = file.string(),
          .level = level,
          .quantile = scores[static_cast<std::size_t>(rank) - 1],
          .integrators = reader.list<std::string>("integrators"),
          .least_resolution = resolutions[0],
          .most_resolution = resolutions[1],
          .least_steps = steps[0],
          .most_steps = steps[1],
          .most_spread = reader.positive("most_spread", 0)};
}

Converged converge(const Scene& scene, const RecommendOptions& options) {
  const bool at_rest = scene.integrator == Integrator::equilibrium;
  Search search(scene, options);
  Converged result;
  const auto value = [&](int side, int steps) {
    for (const Trial& made : result.runs)
      if (made.choice.resolution == triangles(side) && made.choice.steps == steps) return made.value;
    if (!result.missing.empty()) return std::numeric_limits<double>::quiet_NaN();
    result.runs.push_back(
        search.run({options.methods.front(), "multigrid", triangles(side), steps}, tight, options.time_limit));
    const Trial& made = result.runs.back();
    if (made.verdict != "ok")
      result.missing = "its run with " + std::to_string(made.choice.resolution) + " triangles and " +
                       std::to_string(steps) + " steps ended as " + made.verdict + ": " + made.reason;
    return made.value;
  };
  const int n = squares_per_side(scene.resolution), scene_steps = static_cast<int>(steps_of(scene));
  int side = 2 * n, steps = at_rest ? 1 : 2 * scene_steps;
  // First order in the length of edges: strains grow like one over the root of the distance from a tip. First order in
  // the step, too, but for the midpoint rule.
  const double by_step = scene.integrator == Integrator::midpoint ? 1.0 / 3 : 1;
  while (true) {
    const double coarser = value(side / 2, steps), slower = at_rest ? 0 : value(side, steps / 2);
    const double here = value(side, steps);
    if (!result.missing.empty()) {
      if (result.value > 0) result.missing.clear();  // that of the coarser runs is one
      return result;
    }
    const double from_mesh = here - coarser, from_step = at_rest ? 0 : by_step * (here - slower);
    result.value = here + from_mesh + from_step;
    result.spread = std::abs(from_mesh) + std::abs(from_step);
    result.finest = result.runs.back().choice;
    const bool finer_mesh = std::abs(from_mesh) >= std::abs(from_step);
    const double work = (finer_mesh ? 4.0 : 2.0) * side * side * steps / (1.0 * n * n * scene_steps);
    if (result.spread <= spread_share * options.max_error * result.value || work > most_refined) break;
    (finer_mesh ? side : steps) *= 2;
  }
  if (!(result.value > 0)) result.missing = "nothing moves, or opens, in the end";
  return result;
}

Recommendation recommend(const Scene& scene, const RecommendOptions& options, const Calibration& calibration) {
  Recommendation result{.converged = {}, .unknown = beyond(scene, calibration)};
  if (!result.unknown.empty()) return result;
  result.converged = converge(scene, options);
  result.unknown = beyond(result.converged, calibration);
  if (!result.unknown.empty()) return result;
  result.margin = calibration.quantile * result.converged.spread;

  const bool at_rest = scene.integrator == Integrator::equilibrium;
  const std::set<int> all_steps = at_rest ? std::set<int>{1} : ladder(finest * steps_of(scene), steps_span);
  std::vector<std::pair<int, int>> grids;  // triangles, steps
  for (const int side : ladder(finest * squares_per_side(scene.resolution), side_span))
    for (const int steps : all_steps) grids.emplace_back(triangles(side), steps);
  const auto work = [](const std::pair<int, int>& grid) { return 1.0 * grid.first * grid.second; };
  std::stable_sort(grids.begin(), grids.end(), [&](auto a, auto b) { return work(a) < work(b); });

  Search search(scene, options);
  const auto good = [&](const Trial& trial) { return trial.verdict == "ok" && trial.high <= options.max_error; };
  double most_work = std::numeric_limits<double>::infinity(), time_limit = options.time_limit;
  const double seconds = at_rest ? 1 : end_of(scene);
  for (const auto& grid : grids) {
    if (work(grid) > most_work && !options.everything) break;
    for (const std::string& method : options.methods)
      for (const std::string& solver : options.solvers) {
        Trial trial = search.run({method, solver, grid.first, grid.second}, scene.solver.tolerance, time_limit);
        judge(trial, result.converged.value, result.margin);
        if (good(trial) || (options.everything && trial.verdict == "ok")) search.time(trial);
        if (good(trial)) {
          most_work = std::min(most_work, widest * work(grid));
          time_limit = std::min(time_limit, candidate_patience * trial.ms_per_second / 1000 * seconds);
        }
        result.trials.push_back(trial);
        if (!good(trial) && !options.everything) break;
      }
  }

  const auto cheapest = [&] {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < result.trials.size(); ++i)
      if (good(result.trials[i]) && (!best || result.trials[i].ms_per_second < result.trials[*best].ms_per_second))
        best = i;
    return best;
  };
  if (const auto first = cheapest()) {
    const double limit = near_best * result.trials[*first].ms_per_second;
    for (int i = 0; i < more_timings; ++i)
      for (Trial& trial : result.trials)
        if (trial.ms_per_second <= limit) search.time(trial);
  }
  result.chosen = cheapest();
  if (!result.chosen) {
    result.unknown = shortfall(result.trials, options.max_error);
  } else if (const double ms = result.trials[*result.chosen].ms_per_second; ms > options.max_ms) {
    char text[100];
    std::snprintf(text, sizeof text, "the cheapest candidate that is good enough takes %.3g ms for a second", ms);
    result.unknown = text;
    result.chosen.reset();
  }
  return result;
}

}  // namespace cutbench
