#include "experiments/advice/recommend.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/advice/calibration_text.h"
#include "experiments/advice/scene_run.h"
#include "experiments/advice/sheet_levels.h"
#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/scenes/toml_reader.h"

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

/// Triangles of the candidates: at least those that the cuts need, at most `most_triangles`, or the scene's own.
/// \param left_out  how many are too coarse for the cuts
std::set<int> triangles_of(const Scene& scene, SheetLevels& sheets, int& left_out) {
  const int least = triangles_for_cuts(scene, sheets), most = std::max(sheets.own(), most_triangles);
  std::set<int> all;
  if (!scene.mesh) {
    for (const int side : ladder(finest * squares_per_side(scene.resolution), side_span)) all.insert(2 * side * side);
  } else {
    for (double i = 0; std::exp2(i / 2) <= 1.001 * side_span; ++i)
      if (const auto triangles = sheets.triangles(std::exp2(1 - i / 2))) all.insert(*triangles);
  }
  std::erase_if(all, [&](int triangles) { return triangles > most; });
  left_out = to_int(std::erase_if(all, [&](int triangles) { return triangles < least; }));
  return all;
}

/// Triangles and steps of the candidates, the least product first. Explicit steps: 0, as many as are stable.
std::vector<std::pair<int, int>> grids_of(const Scene& scene, const std::set<int>& all_triangles) {
  std::set<int> all_steps{at_rest(scene) ? 1 : 0};
  if (!at_rest(scene) && !is_explicit(scene)) all_steps = ladder(finest * steps_of(scene), steps_span);
  std::vector<std::pair<int, int>> grids;
  for (const int triangles : all_triangles)
    for (const int steps : all_steps) grids.emplace_back(triangles, steps);
  const auto work = [](const std::pair<int, int>& grid) { return 1.0 * grid.first * std::max(1, grid.second); };
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
std::vector<std::string> beyond(const Scene& scene, const SheetLevels& sheets, const Calibration& seen) {
  std::vector<std::string> all;
  const std::string integrator = name_of(integrator_names, scene.integrator);
  if (std::find(seen.integrators.begin(), seen.integrators.end(), integrator) == seen.integrators.end())
    all.push_back("the integrator is " + integrator + ", and the calibration has seen " + listed(seen.integrators));
  if (scene.mesh) all.push_back("the sheet is its own, and the calibration has seen squares");
  all.push_back(outside("the sheet's triangles are", sheets.own(), seen.least_resolution, seen.most_resolution));
  // Explicit steps are as long as they may be, whatever the scene's.
  if (!is_explicit(scene))
    all.push_back(outside("the scene's steps are", steps_of(scene), seen.least_steps, seen.most_steps));
  std::erase(all, "");
  return all;
}

std::string beyond(const Converged& converged, const Calibration& seen) {
  return outside("the spread of the finer runs over the value is", converged.spread / converged.value, 0,
                 seen.most_spread);
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all)
    if (!one.empty()) text += (text.empty() ? "" : "; ") + one;
  return text;
}

std::vector<std::string> notes_of(int left_out, const SheetLevels& sheets, const Converged& converged) {
  std::vector<std::string> notes;
  if (left_out > 0)
    notes.push_back(std::to_string(left_out) + (left_out == 1 ? " coarser sheet is" : " coarser sheets are") +
                    " left out: the least cut is to be two edges wide or long");
  if (!sheets.missing().empty()) notes.push_back("no coarser sheets: " + sheets.missing());
  const auto falls = std::find_if(converged.runs.begin(), converged.runs.end(),
                                  [](const SceneTrial& run) { return run.free_pieces > 0; });
  if (falls != converged.runs.end())
    notes.push_back(std::to_string(falls->free_pieces) +
                    (falls->free_pieces == 1 ? " piece that nothing holds is" : " pieces that nothing holds are") +
                    " left out of the quantity");
  return notes;
}

/// Why no run can help, all reasons at once: empty where runs can.
std::vector<std::string> refusals(const Scene& scene, const SheetLevels& sheets) {
  std::vector<std::string> all;
  if (sweeps(scene.integrator))
    all.push_back(std::string(name_of(integrator_names, scene.integrator)) +
                  "'s stiffness depends on its steps and sweeps, so that there is no converged value; name another "
                  "integrator");
  if (sheets.own() > most_triangles)
    all.push_back("the sheet has " + std::to_string(sheets.own()) + " triangles, and at most " +
                  std::to_string(most_triangles) + " are run; give a coarser one");
  return all;
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
  Candidates(const Scene& scene, SheetLevels& sheets, const RecommendOptions& options)
      : scene_(scene), options_(options), runs_(scene, sheets, options.quantity, options.cut) {
    grids_ = grids_of(scene, triangles_of(scene, sheets, left_out_));
  }

  int left_out() const { return left_out_; }  ///< sheets that are too coarse for the cuts

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
      for (const std::string& method : options_.methods) {
        const int made = steps > 0 ? steps : stable_steps(method, triangles);
        for (const std::string& solver : options_.solvers) {
          if (made == 0) break;
          const SceneTrial& trial = tried({method, solver, triangles, made}, time_limit);
          if (good(trial)) {
            most_work = std::min(most_work, widest * work);
            time_limit = std::min(time_limit, candidate_patience * trial.ms_per_second / 1000 * seconds);
          }
          if (is_explicit(scene_) || (!may_be_good(trial) && !options_.everything)) break;
        }
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

  /// 0: none.
  int stable_steps(const std::string& method, int triangles) {
    const auto [known, is_new] = stable_steps_.try_emplace({method, triangles}, 0);
    if (is_new) known->second = runs_.stable_steps(method, triangles).value_or(0);
    return known->second;
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
  int left_out_ = 0;
  std::map<std::pair<std::string, int>, int> stable_steps_;  ///< by method and triangles
  double converged_ = std::numeric_limits<double>::quiet_NaN(), margin_ = converged_;
  std::vector<SceneTrial> trials_;
};

ConvergedValue converged_value(const Scene& scene, SheetLevels& sheets, const RecommendOptions& options) {
  ConvergedValue converged(scene, options.methods.front(), sheets, {scene, sheets, options.quantity, options.cut},
                           options.time_limit);
  const Converged& result = converged.get();
  while (result.missing.empty() && result.spread > spread_share * options.max_error * result.value)
    if (!converged.refine(most_refined)) break;
  return converged;
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& file) {
  const std::string name = file.empty() ? "the built-in calibration" : file.string();
  const toml::table table = file.empty() ? parse_toml_text(calibration_text, name) : parse_toml(file);
  check_keys(table, {"source", "level", "scores", "integrators", "resolutions", "steps", "most_spread"}, name);
  const TomlReader reader{table, name};
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
  return {.file = name,
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
  SheetLevels sheets(scene);
  return converged_value(scene, sheets, options).get();
}

Recommendation recommend(const Scene& scene, const RecommendOptions& options, const Calibration& calibration) {
  SheetLevels sheets(scene);
  Recommendation result{.converged = {}, .unknown = joined(refusals(scene, sheets))};
  if (!result.unknown.empty()) return result;
  result.beyond = beyond(scene, sheets, calibration);
  const std::vector<std::string> of_scene = result.beyond;
  ConvergedValue converged = converged_value(scene, sheets, options);
  const Choice unrefined = converged.get().finest;
  Candidates candidates(scene, sheets, options);
  result.notes = notes_of(candidates.left_out(), sheets, converged.get());
  do {
    result.converged = converged.get();
    result.refined_to_decide = !(result.converged.finest == unrefined);
    result.margin = std::numeric_limits<double>::quiet_NaN();
    result.unknown = result.converged.missing;
    if (!result.unknown.empty()) return result;  // what was tried until now was judged by another value
    result.beyond = of_scene;
    if (const std::string spread = beyond(result.converged, calibration); !spread.empty())
      result.beyond.push_back(spread);
    result.margin = calibration.quantile * result.converged.spread * (result.beyond.empty() ? 1 : guessed_margin);
    if (result.margin >= result.converged.value) {
      result.unknown = joined({"the converged value may be 0, given its margin", joined(result.beyond)});
      return result;
    }
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
