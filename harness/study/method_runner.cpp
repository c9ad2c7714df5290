#include "harness/study/method_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <string>

#include "harness/base/conversions.h"
#include "harness/base/own_seed.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut_all.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/families.h"
#include "harness/records/metrics.h"
#include "harness/simulation/simulation.h"
#include "harness/study/chill_caches.h"
#include "harness/study/every_edge.h"
#include "harness/study/rebuild_times.h"
#include "harness/study/study_run.h"
#include "harness/study/summary.h"
#include "harness/study/worker.h"

namespace cutbench {

namespace {

/// The skin of experiments/scenes, whose side is 1 m: 2 mm thick.
constexpr Elasticity bent_skin{.poisson = 0.45, .bending = BendingKind::patches, .bending_length2 = 4.2e-7};

constexpr const char* every_edge_row = "every_edge";  // in the column of methods

/// A cut that takes longer, its judgement included, is ended.
constexpr double longest_cut_s = 600;

/// A cut and what is known of it, for all methods.
struct Case {
  std::string sheet, family;
  int resolution = 0;
  std::size_t number = 0;
  std::vector<Curve> cuts;
  std::vector<oracle::ForcedCorner> forced;
};

class Runner : public StudyRun {
 public:
  Runner(const Experiment& experiment, const CutStudy& plan, const std::vector<MethodRow>& methods,
         const Context& context, const RunOptions& options)
      : StudyRun(experiment, context, options, column_names()), plan_(plan) {
    for (const Variant& v : variants_of(experiment, methods)) workers_.emplace_back(v);
    cut_options_.chord_tolerance = experiment.chord_tolerance;
  }

 private:
  std::size_t case_count() override {
    return experiment_.sized_sheets().size() * plan_.cut_families.size() * to_size(plan_.cases);
  }

  void run_cases(Progress& progress) override {
    const auto cases = to_size(plan_.cases);
    for (const auto& [sheet, resolution] : experiment_.sized_sheets()) {
      bool is_made = false;
      for (const auto& family : plan_.cut_families) {
        const std::vector<std::size_t> numbers = next_ours(cases);
        if (!numbers.empty() && !is_made) {
          make_base(sheet, resolution);
          is_made = true;
        }
        if (plan_.times)
          for (const std::size_t i : numbers) {
            run_case(drawn(sheet, resolution, family, i));
            progress.step();
          }
        else {
          judge_on_all_cores(sheet, resolution, family, numbers);
          progress.step(numbers.size());
        }
        progress.step(cases - numbers.size());
      }
    }
  }

  /// What was wrong in a case's judgement, its first repetition, is wrong in all.
  void add_row(const Record& row, RightResults& results) override {
    results.add(row);
    const std::string &cache = row.get("cache"), &method = row.get("method");
    const bool is_wrong = row.get("verdict") != "ok";
    if (cache == "cold") return;
    if (cache == "simulation") {
      if (is_wrong) summary_.add_failure();
      return;
    }
    std::string of_case;
    for (const char* key : {"sheet", "resolution", "method", "parameter", "cut_family", "case"})
      of_case += row.get(key) + ',';
    if (is_wrong && method != every_edge_row) wrong_cases_.insert(of_case);
    const auto number = [&](const char* column) {
      const std::string& text = row.get(column);
      return text.empty() ? -1 : std::stod(text);
    };
    summary_.add(to_int(std::stoul(row.get("resolution"))), method, row.get("parameter"),
                 {.ok = !wrong_cases_.contains(of_case),
                  .refused = row.get("status") == name_of(Status::refused),
                  .crossed_triangles = number("crossed_triangles"),
                  .vertices_added = number("vertices_added"),
                  .ar_max_cut = number("ar_max_cut"),
                  .over_3_cut = number("over_3_cut"),
                  .geometry_us = number("geometry_us")});
  }
  void print_summary() const override { summary_.print(experiment_.stem); }
  bool all_ok() const override { return summary_.all_ok(); }

  void make_base(const std::string& sheet, int resolution) {
    start_scene(sheet, resolution);
    base_ = BaseSheet(motion_ ? motion_->sheet() : Sheet(make_sheet(sheet, squares_per_side(resolution))));
    for (Worker& worker : workers_) worker.forget_base();
    if (plan_.eigenvalue_cases > 0) {
      base_eigenvalue_ = largest_eigenvalue(base_.sheet);
      base_bending_ = largest_eigenvalue(base_.sheet, {}, bent_skin);
    }
  }

  Case drawn(const std::string& sheet, int resolution, const std::string& family, std::size_t i) const {
    std::uint64_t seed = experiment_.seed;
    if (plan_.own_cuts) seed = own_seed(own_seed(seed, sheet), std::to_string(resolution));
    return {sheet, family, resolution, i, make_case(family, seed, i, base_.sheet), {}};
  }

  Record start_row(const Case& c, const std::string& method, const std::string& parameter, int repetition,
                   const char* cache) const {
    Record row = StudyRun::start_row(c.sheet, c.resolution, method, parameter);
    row.set("cut_family", c.family);
    row.set("case", to_int64(c.number));
    row.set("repetition", std::int64_t{repetition});
    row.set("cache", std::string(cache));
    return row;
  }
  Record start_row(const Case& c, const Worker& worker, int repetition, const char* cache) const {
    return start_row(c, worker.variant.row->name, worker.variant.parameter_text(), repetition, cache);
  }

  /// Cuts and fills the row of the first repetition.
  void judge(Case& c, Worker& worker, Record& row) {
    const CutRun run = worker.cut(base_, c.cuts, cut_options_);
    if (c.forced.empty() && plan_.quality) c.forced = forced_corners_of(base_.sheet, c.cuts);
    judge_into(row, worker, c.cuts, c.forced, run);
    if (to_int(c.number) < plan_.eigenvalue_cases && row.get("verdict") == "ok" &&
        (run.status == Status::ok || run.status == Status::deviated))
      fill_eigenvalues(row, worker);
  }

  /// What a child process tells of a cut.
  struct Told {
    std::array<char, 4000> line{};
  };

  void judge_on_all_cores(const std::string& sheet, int resolution, const std::string& family,
                          const std::vector<std::size_t>& numbers) {
    std::vector<Case> cases;
    for (const std::size_t i : numbers) cases.push_back(drawn(sheet, resolution, family, i));
    std::vector<std::pair<Case*, Worker*>> missing;
    for (Case& c : cases)
      for (Worker& worker : workers_)
        if (!file_.has(start_row(c, worker, 0, "warm"))) missing.emplace_back(&c, &worker);
    run_apart<Told>(
        missing.size(), longest_cut_s,
        [&](std::size_t k, Told& told) {
          Record row = start_row(*missing[k].first, *missing[k].second, 0, "warm");
          judge(*missing[k].first, *missing[k].second, row);
          for (const std::string& time : columns_of({Group::time})) row.set(time, std::string());
          row.line().copy(told.line.data(), told.line.size() - 1);
        },
        [&](std::size_t k, const Told& told, Fate fate) { record(*missing[k].first, *missing[k].second, told, fate); });
  }

  void record(const Case& c, const Worker& worker, const Told& told, Fate fate) {
    Record row = start_row(c, worker, 0, "warm");
    if (fate == Fate::done) {
      row = Record(column_names(), told.line.data());
    } else {
      row.set("status", std::string(name_of(Status::failed)));
      set_fate(row, fate);
    }
    file_.append(row);
  }

  void run_case(Case c) {
    // A first, unrecorded cut by each method, which is judged and warms up; then the repetitions with the methods in
    // turn, so that a slow spell of the machine hits all alike.
    std::vector<Record> judged;
    for (std::size_t w = 0; w < workers_.size(); ++w) {
      Record& row = judged.emplace_back(start_row(c, workers_[w], 0, "warm"));
      if (!file_.has(row)) judge(c, workers_[w], row);
    }
    std::size_t crossed = 0;
    for (int r = 0; r < plan_.repetitions + (plan_.cold ? 1 : 0); ++r) {
      const bool cold = r == plan_.repetitions;
      const int repetition = cold ? 0 : r;
      const char* cache = cold ? "cold" : "warm";
      for (std::size_t w = 0; w < workers_.size(); ++w) {
        Worker& worker = workers_[w];
        Record row = start_row(c, worker, repetition, cache);
        if (file_.has(row)) continue;
        const CutRun run = worker.measure(base_, c.cuts, cut_options_, cold);
        if (run.crossed_triangles > 0) crossed = run.crossed_triangles;
        if (r == 0)
          fill(row = judged[w], {.cut = &run}, {Group::time});
        else
          fill(row, {.cut = &run});
        file_.append(row);
      }
      if (plan_.every_edge && crossed == 0)  // all rows but this one were there
        for (Worker& worker : workers_)
          crossed = std::max(crossed, worker.cut(base_, c.cuts, cut_options_).crossed_triangles);
      if (plan_.every_edge) time_every_edge(c.cuts, start_row(c, every_edge_row, "", repetition, cache), crossed, cold);
    }
    if (!motion_ || c.number >= to_size(plan_.scene_cases)) return;
    for (Worker& worker : workers_) run_in_motion(c.cuts, worker, start_row(c, worker, 0, "simulation"));
  }

  void fill_eigenvalues(Record& row, const Worker& worker) const {
    Measured measured{.membrane = ratios(worker.sheet, worker.constraints, {}, base_eigenvalue_)};
    measured.bent = ratios(worker.sheet, worker.constraints, bent_skin, base_bending_);
    fill(row, measured, {Group::stability});
  }

  EigenvalueRatios ratios(const Sheet& sheet, const Constraints& constraints, Elasticity elasticity,
                          double base) const {
    EigenvalueRatios ratios{.lumped = largest_eigenvalue(sheet, constraints, elasticity) / base};
    if (!constraints.constraints.empty()) return ratios;
    elasticity.mass_limit = largest_element_eigenvalue(base_.sheet, elasticity);
    elasticity.mass = Mass::stabilised;
    ratios.stabilised = largest_eigenvalue(sheet, constraints, elasticity) / base;
    elasticity.mass = Mass::scaled;
    ratios.scaled = largest_eigenvalue(sheet, constraints, elasticity) / base;
    ratios.scaled_added = added_mass_share(sheet, constraints, elasticity);
    return ratios;
  }

  /// The experiment's scene on this sheet, brought to the last step before the cut.
  void start_scene(const std::string& sheet, int resolution) {
    if (!plan_.scene) return;
    scene_ = *plan_.scene;
    scene_.family = sheet;
    scene_.resolution = resolution;
    motion_ = Simulation::start(scene_);
    const StepReport report = motion_->advance(plan_.cut_time - scene_.step, *workers_.front().method, cut_options_);
    if (report.verdict != Verdict::ok)
      throw InputError(scene_.stem + ": the scene fails before its cut (" + name_of(report.verdict) + "; " +
                       report.reason + "); change its step or its solver");
  }

  /// The cut made in the running scene, where nothing is warmed up for it.
  void run_in_motion(const std::vector<Curve>& cuts, Worker& worker, Record row) {
    if (file_.has(row)) return;
    const MotionCut m = motion_->try_cut(cuts, worker.cutter, *worker.method, cut_options_);
    const RebuildTimes rebuild = m.verdict == Verdict::ok
                                     ? time_rebuild(scene_, pins_of(scene_, motion_->sheet()), motion_->tried_sheet())
                                     : RebuildTimes();
    fill(row, {.cut = &m.cut, .motion = &m, .rebuild = rebuild});
    file_.append(row);
  }

  void judge_into(Record& row, const Worker& worker, const std::vector<Curve>& cuts,
                  const std::vector<oracle::ForcedCorner>& forced, const CutRun& run) {
    fill(row, {.cut = &run, .judged = true});
    if (run.status == Status::failed || run.status == Status::refused) return;
    const Variant& v = worker.variant;
    const Judgement judgement =
        judge_one_by_one(base_.sheet, worker.sheet, cuts, v.row->promises, v.row->make(v.parameter), cut_options_);
    const Assessment a = assess(base_.sheet, worker.sheet, judgement, forced);
    fill(row, {.h = base_.sheet.mean_edge(), .cut = &run, .judged = true, .assessment = &a, .shapes = plan_.quality});
  }

  void time_every_edge(const std::vector<Curve>& cuts, Record row, std::size_t crossed, bool cold) {
    if (file_.has(row)) return;
    if (cold) chill_caches();
    const auto start = std::chrono::steady_clock::now();
    std::size_t crossings = 0;
    for (const Curve& curve : cuts)
      if (curve.kind == Curve::Kind::bezier) crossings += count_crossings_by_every_edge(base_.sheet, curve);
    const double us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    row.set("geometry_us", us);
    row.set("status", std::string("ok"));
    row.set("verdict", std::string(name_of(crossings > 0 ? Verdict::ok : Verdict::not_terminated)));
    row.set("crossed_triangles", to_int64(crossed));  // the cut's, as a unit
    file_.append(row);
  }

  const CutStudy& plan_;
  std::vector<Worker> workers_;
  CutOptions cut_options_;
  BaseSheet base_;
  double base_eigenvalue_ = 0, base_bending_ = 0;  // of its sheet, where they are asked for
  Scene scene_;                                    // on the sheet of now
  std::unique_ptr<Simulation> motion_;
  Summary summary_;
  std::set<std::string> wrong_cases_;
};

}  // namespace

bool run_methods(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                 const RunOptions& options) {
  return Runner(experiment, std::get<CutStudy>(experiment.study), methods, context, options).run();
}

}  // namespace cutbench
