#include "experiments/advice/recommend.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "experiments/advice/scene_run.h"
#include "harness/base/conversions.h"
#include "harness/files/toml_reader.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

constexpr double finest = 2, side_span = 8, steps_span = 16;  // of the candidates: times the scene's; over the coarsest
constexpr double spread_share = 0.2;  // of the error asked for: the spread of the converged value that is small enough
// Triangles x steps of the finest run for the converged value, over the scene's; and where a cheaper candidate waits.
constexpr double most_refined = 64, most_refined_to_decide = 256;
constexpr double much_cheaper = 1.25;  // the best over an undecided candidate, in cost: worth refining
constexpr double widest = 8;  // triangles x steps over those of the first good candidate: more is not the cheapest
constexpr double candidate_patience =
    4;                             // of a candidate's run, watching it included: times the cheapest good one so far
constexpr double near_best = 1.5;  // in cost: timed again
constexpr int more_timings = 3;

/// value, value / sqrt(2), ... value / span, rounded; each once, the smallest first.
std::set<int> ladder(double value, double span) {
  std::set<int> rungs;
  for (double i = 0; std::exp2(i / 2) <= 1.001 * span; ++i)
    rungs.insert(std::max(1, to_int(std::lround(value / std::exp2(i / 2)))));
  return rungs;
}

/// Triangles and steps of the candidates, the least product first.
std::vector<std::pair<int, int>> grids_of(const Scene& scene) {
  const std::set<int> all_steps = at_rest(scene) ? std::set<int>{1} : ladder(finest * steps_of(scene), steps_span);
  std::vector<std::pair<int, int>> grids;
  for (const int side : ladder(finest * squares_per_side(scene.resolution), side_span))
    for (const int steps : all_steps) grids.emplace_back(2 * side * side, steps);
  const auto work = [](const std::pair<int, int>& grid) { return 1.0 * grid.first * grid.second; };
  std::stable_sort(grids.begin(), grids.end(), [&](auto a, auto b) { return work(a) < work(b); });
  return grids;
}

/// The error lies between those for the ends of the interval of the converged value, or down to 0 where it has `value`.
void judge(SceneTrial& trial, double converged, double margin) {
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
std::string shortfall(const std::vector<SceneTrial>& trials, double max_error) {
  const SceneTrial* best = nullptr;
  for (const SceneTrial& trial : trials)
    if (trial.verdict == Verdict::ok && (!best || trial.high < best->high)) best = &trial;
  if (!best) return "no candidate ended as ok";
  char text[200];
  if (best->low <= max_error)
    std::snprintf(text, sizeof text, "the error of the best candidate is %.3g to %.3g %%; give a finer scene",
                  100 * best->low, 100 * best->high);
  else
    std::snprintf(text, sizeof text, "the best candidate errs by %.3g %% or more; give a finer scene", 100 * best->low);
  return text;
}

/// Those of all methods, solvers, triangles and steps that were tried, and what is known of their errors.
class Candidates {
 public:
  Candidates(const Scene& scene, const RecommendOptions& options)
      : scene_(scene), options_(options), runs_(scene, options.quantity, options.cut), grids_(grids_of(scene)) {}

  const std::vector<SceneTrial>& trials() const { return trials_; }

  void judge(double converged, double margin) {
    converged_ = converged;
    margin_ = margin;
    for (SceneTrial& trial : trials_) cutbench::judge(trial, converged, margin);
  }

  /// The least triangles x steps first, until what is left can't be the cheapest; by the next solvers only where the
  /// error by the first may be small enough. Times what may be chosen.
  void try_those_left() {
    const double seconds = at_rest(scene_) ? 1 : end_of(scene_);
    double most_work = std::numeric_limits<double>::infinity(), time_limit = options_.time_limit;
    for (const auto& [triangles, steps] : grids_) {
      const double work = 1.0 * triangles * steps;
      if (work > most_work && !options_.everything) break;
      for (const std::string& method : options_.methods)
        for (const std::string& solver : options_.solvers) {
          const SceneTrial& trial = tried({method, solver, triangles, steps}, time_limit);
          if (good(trial)) {
            most_work = std::min(most_work, widest * work);
            time_limit = std::min(time_limit, candidate_patience * trial.ms_per_second / 1000 * seconds);
          }
          if (!may_be_good(trial) && !options_.everything) break;
        }
    }
    if (const auto first = cheapest()) {
      const double limit = near_best * trials_[*first].ms_per_second;
      for (int i = 0; i < more_timings; ++i)
        for (SceneTrial& trial : trials_)
          if (may_be_good(trial) && trial.ms_per_second <= limit && trial.timings <= more_timings) runs_.time(trial);
    }
  }

  std::optional<std::size_t> cheapest() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < trials_.size(); ++i)
      if (good(trials_[i]) && (!best || trials_[i].ms_per_second < trials_[*best].ms_per_second)) best = i;
    return best;
  }

  /// Or some candidate where none is good.
  bool much_cheaper_is_undecided() const {
    const auto best = cheapest();
    const double limit = best ? trials_[*best].ms_per_second / much_cheaper : std::numeric_limits<double>::infinity();
    return std::any_of(trials_.begin(), trials_.end(), [&](const SceneTrial& trial) {
      return may_be_good(trial) && !good(trial) && trial.ms_per_second < limit;
    });
  }

 private:
  bool good(const SceneTrial& trial) const { return trial.verdict == Verdict::ok && trial.high <= options_.max_error; }
  bool may_be_good(const SceneTrial& trial) const {
    return trial.verdict == Verdict::ok && trial.low <= options_.max_error;
  }

  /// Now, or before.
  const SceneTrial& tried(const Choice& choice, double time_limit) {
    auto trial = std::find_if(trials_.begin(), trials_.end(), [&](const SceneTrial& t) { return t.choice == choice; });
    const bool is_new = trial == trials_.end();
    if (is_new) trial = trials_.insert(trial, SceneTrial{});
    if (is_new || (trial->verdict == Verdict::timed_out && trial->time_limit < time_limit)) {
      *trial = runs_.run(choice, scene_.solver.tolerance, time_limit);
      cutbench::judge(*trial, converged_, margin_);
    }
    const bool worth_timing = may_be_good(*trial) || (options_.everything && trial->verdict == Verdict::ok);
    if (worth_timing && std::isnan(trial->ms_per_second)) runs_.time(*trial);
    return *trial;
  }

  const Scene& scene_;
  const RecommendOptions& options_;
  SceneTrials runs_;
  std::vector<std::pair<int, int>> grids_;
  double converged_ = std::numeric_limits<double>::quiet_NaN(), margin_ = converged_;
  std::vector<SceneTrial> trials_;
};

ConvergedValue converged_value(const Scene& scene, const RecommendOptions& options) {
  ConvergedValue converged(scene, options.methods.front(), {scene, options.quantity, options.cut}, options.time_limit);
  const Converged& result = converged.get();
  while (result.missing.empty() && result.spread > spread_share * options.max_error * result.value)
    if (!converged.refine(most_refined)) break;
  return converged;
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
  const double rank = std::ceil(level * to_double(scores.size() + 1) - 1e-9);  // Lei et al. 2018, section 2.2
  if (rank > to_double(scores.size()))
    reader.refuse("a level of " + std::to_string(level) + " takes more than " + std::to_string(scores.size()) +
                  " scores");
  return {.file = file.string(),
          .level = level,
          .quantile = scores[to_size(rank) - 1],
          .integrators = reader.list<std::string>("integrators"),
          .least_resolution = resolutions[0],
          .most_resolution = resolutions[1],
          .least_steps = steps[0],
          .most_steps = steps[1],
          .most_spread = reader.positive("most_spread", 0)};
}

Converged converge(const Scene& scene, const RecommendOptions& options) {
  return converged_value(scene, options).get();
}

Recommendation recommend(const Scene& scene, const RecommendOptions& options, const Calibration& calibration) {
  Recommendation result{.converged = {}, .unknown = beyond(scene, calibration)};
  if (!result.unknown.empty()) return result;
  ConvergedValue converged = converged_value(scene, options);
  const Choice unrefined = converged.get().finest;
  Candidates candidates(scene, options);
  do {
    result.converged = converged.get();
    result.refined_to_decide = !(result.converged.finest == unrefined);
    result.margin = std::numeric_limits<double>::quiet_NaN();
    result.unknown = beyond(result.converged, calibration);
    if (!result.unknown.empty()) return result;  // what was tried until now was judged by another value
    result.margin = calibration.quantile * result.converged.spread;
    candidates.judge(result.converged.value, result.margin);
    candidates.try_those_left();
  } while (!options.everything && candidates.much_cheaper_is_undecided() && converged.refine(most_refined_to_decide));

  result.trials = candidates.trials();
  result.chosen = candidates.cheapest();
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
