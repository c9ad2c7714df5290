#include "harness/study/stability/stability.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/records/metrics.h"
#include "harness/study/stability/placed_cuts.h"
#include "harness/study/stability/try_point.h"
#include "harness/study/study_run.h"

namespace cutbench {

namespace {

/// Points between two writes to the file: what a killed run has to do again.
constexpr std::size_t batch = 200;

template <class T>
bool wants(const std::vector<T>& some, const T& one) {
  return some.empty() || std::find(some.begin(), some.end(), one) != some.end();
}

class StabilityRun : public StudyRun {
 public:
  StabilityRun(const Experiment& experiment, const StabilityStudy& plan, const std::vector<MethodRow>& methods,
               const Context& context, const RunOptions& options)
      : StudyRun(experiment, context, options, stability_columns(), stability_key_columns()),
        plan_(plan),
        variants_(variants_of(experiment, methods)) {
    std::vector<std::string> cuts(placed_cuts().begin(), placed_cuts().end());
    cuts.insert(cuts.end(), cut_families().begin(), cut_families().end());
    for (const Sweep& sweep : plan.sweeps)
      for (const SweepPoint& point : sweep.points)
        check_names({point.cut}, cuts, experiment.stem + ", sweep \"" + sweep.name + "\": cut");
  }

 private:
  std::size_t case_count() override {
    trials_ = missing_trials();
    return trials_.size();
  }

  void run_cases(Progress& progress) override {
    for (std::size_t begin = 0; begin < trials_.size(); begin += batch) {
      const std::size_t n = std::min(batch, trials_.size() - begin);
      run_apart<TrialResult>(
          n, plan_.time_limit_s, [&](std::size_t i, TrialResult& result) { try_point(trials_[begin + i], result); },
          [&](std::size_t i, const TrialResult& result, Fate fate) { append(trials_[begin + i], result, fate); },
          [&](std::size_t begun) { progress.show(begun); });
      progress.step(n);
    }
  }

  void add_row(const Record& row, RightResults&) override {
    const std::string& verdict = row.get("verdict");
    ++counts_[row.get("sweep")][verdict];
    all_ok_ &= verdict != "crashed" && verdict != "failed" && verdict != "timed_out";
  }
  void print_summary() const override {
    for (const Sweep& sweep : plan_.sweeps) {
      std::printf("%-24s", sweep.name.c_str());
      if (const auto counts = counts_.find(sweep.name); counts != counts_.end())
        for (const auto& [verdict, n] : counts->second) std::printf(" %zu %s", n, verdict.c_str());
      std::printf("\n");
    }
  }
  bool all_ok() const override { return all_ok_; }

  /// Those of the shard that are not in the file yet. The points of a sweep stay together, methods in turn.
  std::vector<Trial> missing_trials() {
    std::vector<Trial> trials;
    for (const Sweep& sweep : plan_.sweeps)
      for (const auto& [sheet, resolution] : experiment_.sized_sheets()) {
        if (!wants(sweep.sheets, sheet) || !wants(sweep.resolutions, resolution)) continue;
        for (const SweepPoint& point : sweep.points)
          for (int i = 0; i < std::min(sweep.cases, plan_.cases); ++i)
            for (const Variant& variant : variants_) {
              if (!wants(sweep.methods, variant.row->name)) continue;
              if (!next_is_ours()) continue;
              Trial trial{.sweep = &sweep,
                          .point = &point,
                          .variant = &variant,
                          .sheet = sheet,
                          .resolution = resolution,
                          .index = to_size(i),
                          .seed = experiment_.seed,
                          .options = {.chord_tolerance = experiment_.chord_tolerance},
                          .uncut_step_s = 0};
              if (file_.has(start_row(trial))) continue;
              trial.uncut_step_s = uncut_step(trial);
              trials.push_back(trial);
            }
      }
    return trials;
  }

  double uncut_step(const Trial& trial) {
    if (!trial.point->eigenvalue && trial.point->step_share == 0) return 0;
    Scene scene = trial.point->scene;
    scene.family = trial.sheet;
    scene.resolution = trial.resolution;
    const Material& m = scene.material;
    const auto key = std::tuple(trial.sheet, trial.resolution, trial.sweep->scene_file.string(), m.stiffness, m.poisson,
                                m.stiffness_damping, m.mass_damping, scene.physics.bending);
    const auto [entry, is_new] = uncut_steps_.try_emplace(key, 0);
    if (is_new) entry->second = explicit_step_of(scene, Sheet(mesh_of(scene)));
    return entry->second;
  }

  Record start_row(const Trial& trial) const {
    Record row =
        StudyRun::start_row(trial.sheet, trial.resolution, trial.variant->row->name, trial.variant->parameter_text());
    row.set("sweep", trial.sweep->name);
    row.set("case", to_int64(trial.index));
    row.set("repetition", std::int64_t{0});
    row.set("cache", std::string(trial.sweep->steps > 0 ? "simulation" : "cold"));
    for (const SweepSetting& setting : sweep_settings()) row.set(setting.name, setting.get(*trial.point));
    return row;
  }

  void append(const Trial& trial, const TrialResult& result, Fate fate) {
    Record row = start_row(trial);
    row.set("status", std::string(result.status.data()));
    row.set("verdict", std::string(result.verdict.data()));
    set_fate(row, fate);
    row.set("reason", std::string(result.reason.data()));
    for (std::size_t m = 0; m < point_measures().size(); ++m)
      if (!std::isnan(result.measure[m])) row.set(point_measures()[m], result.measure[m]);
    file_.append(row);
  }

  const StabilityStudy& plan_;
  std::vector<Variant> variants_;
  std::vector<Trial> trials_;  // those to run, which point into the experiment and the variants
  std::map<std::string, std::map<std::string, std::size_t>> counts_;  // by sweep and verdict
  bool all_ok_ = true;
  std::map<std::tuple<std::string, int, std::string, double, double, double, double, BendingKind>, double> uncut_steps_;
};

}  // namespace

std::size_t stability_key_columns() { return key_columns + sweep_settings().size(); }

const std::vector<std::string>& stability_columns() {
  static const std::vector<std::string> columns = record_columns("sweep", stability_metrics());
  return columns;
}

bool run_stability(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                   const RunOptions& options) {
  return StabilityRun(experiment, std::get<StabilityStudy>(experiment.study), methods, context, options).run();
}

}  // namespace cutbench
