#include "harness/study/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/base/own_seed.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/problem.h"
#include "harness/records/metrics.h"
#include "harness/study/accuracy_summary.h"
#include "harness/study/study_run.h"
#include "harness/study/worker.h"

namespace cutbench {

namespace {

/// Errors of the reference below it are round-off: no measuring stick.
constexpr double exact_to_rounding = 1e-9;

/// Solver, budget and tip functions, too, say what was measured.
constexpr std::size_t accuracy_key_columns = key_columns + 3;

using Clock = std::chrono::steady_clock;

double us_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

/// The errors of the reference, solved directly, by the name of the measure.
using Yardstick = std::map<std::string, double>;

class AccuracyRun : public StudyRun {
 public:
  AccuracyRun(const Experiment& experiment, const AccuracyStudy& plan, const std::vector<MethodRow>& methods,
              const Context& context, const RunOptions& options)
      : StudyRun(experiment, context, options, accuracy_columns(), accuracy_key_columns), plan_(plan) {
    for (const Variant& v : variants_of(experiment, methods)) workers_.emplace_back(v);
    for (const auto& solver : plan_.direct) direct_.push_back({.solver = {.name = solver}});
    budgets_ = direct_;
    if (plan_.tip_functions)
      for (Budget with : direct_) {
        with.tip_functions = true;
        budgets_.push_back(with);
      }
    for (const auto& solver : plan_.preconditioners)
      for (int n : plan_.iterations) budgets_.push_back({.solver = {.name = solver}, .iterations = n});
    cut_options_.chord_tolerance = experiment.chord_tolerance;
  }

 private:
  std::size_t case_count() override {
    std::size_t total = 0;
    for (const auto& name : plan_.problems)
      for (const auto& sheet : experiment_.sized_sheets()) total += members(find_problem(name), sheet.resolution);
    return total;
  }

  void run_cases(Progress& progress) override {
    for (const auto& name : plan_.problems) {
      const Problem& problem = find_problem(name);
      for (const auto& [sheet, resolution] : experiment_.sized_sheets())
        for (std::size_t i = 0; i < members(problem, resolution); ++i, progress.step())
          if (next_is_ours()) run_member(problem, sheet, resolution, i);
    }
  }

  void add_row(const Record& row, RightResults& results) override {
    results.add(row);
    summary_.add(row);
  }
  void print_summary() const override { summary_.print(experiment_.stem, minutes_); }
  bool all_ok() const override { return summary_.all_ok(); }

  std::size_t members(const Problem& problem, int resolution) const {
    const auto& plan = problem.takes_budgets() ? plan_.members : plan_.members_nonlinear;
    const auto found =
        std::find_if(plan.begin(), plan.end(), [&](const auto& entry) { return entry.first == resolution; });
    return to_size(found->second);
  }

  const std::vector<Budget>& budgets_for(const Problem& problem) const {
    return problem.takes_budgets() ? budgets_ : direct_;
  }

  void run_member(const Problem& problem, const std::string& family, int resolution, std::size_t i) {
    const auto of_method = [&](const std::string& method, const std::string& parameter) {
      Record row = start_row(family, resolution, method, parameter);
      row.set("problem", problem.name());
      row.set("case", to_int64(i));
      row.set("repetition", std::int64_t{0});
      row.set("cache", std::string("warm"));
      row.set("primary", problem.measures().front());
      return row;
    };
    const auto of_worker = [&](const Worker& worker) {
      return of_method(worker.variant.row->name, worker.variant.parameter_text());
    };
    const Record of_reference = of_method(reference_method, ""), of_graded = of_method(graded_method, "");
    const bool graded = plan_.graded_reference && problem.takes_budgets();
    if ((!plan_.reference || is_done(of_reference, problem)) && (!graded || is_done(of_graded, problem)) &&
        std::all_of(workers_.begin(), workers_.end(),
                    [&](const Worker& worker) { return is_done(of_worker(worker), problem); }))
      return;

    const Specimen specimen =
        problem.specimen(family, squares_per_side(resolution), own_seed(experiment_.seed, problem.name()), i);
    const BaseSheet base{Sheet(specimen.mesh)};
    Yardstick yardstick;
    if (plan_.reference) yardstick = run_reference(problem, specimen, base, of_reference, body_fitted, {});
    if (graded && !is_done(of_graded, problem))
      run_reference(problem, specimen, base, of_graded, graded_at_tips, yardstick);
    for (Worker& worker : workers_)
      if (!is_done(of_worker(worker), problem))
        run_method(problem, specimen, base, worker, of_worker(worker), yardstick);
  }

  bool is_done(Record row, const Problem& problem) const {
    const auto& budgets = budgets_for(problem);
    return std::all_of(budgets.begin(), budgets.end(), [&](const Budget& budget) {
      set_budget(row, budget);
      return file_.has(row);
    });
  }

  static void set_budget(Record& row, const Budget& budget) {
    row.set("solver", budget.solver.name);
    row.set("budget", std::int64_t{budget.iterations});
    row.set("tip_functions", std::int64_t{budget.tip_functions});
  }

  Yardstick run_reference(const Problem& problem, const Specimen& specimen, const BaseSheet& base, Record row,
                          Sheet (*mesh)(const Specimen&), const Yardstick& yardstick) {
    const auto start = Clock::now();
    row.set("exact_incision", std::int64_t{1});
    std::optional<Sheet> sheet;
    try {
      sheet = mesh(specimen);
      row.set("cut_us", us_since(start));
      // Its edges are chords of about h: what they cut off a curve is part of its error, not a fault.
      CutOptions chords = cut_options_;
      chords.chord_tolerance = std::numeric_limits<double>::infinity();
      const Assessment a =
          assess_result(base.sheet, sheet->to_mesh_data(), specimen.cuts, promises_of_everybody, chords);
      row.set("status", std::string("ok"));
      set_assessment(row, nullptr, a, base);
      if (!a.judgement.ok) sheet.reset();
    } catch (const std::exception& error) {
      set_failure(row, "failed", "crashed", error.what());
      sheet.reset();
    }
    const Yardstick errors = answer(problem, specimen, sheet ? &*sheet : nullptr, {}, row, yardstick);
    minutes_[row.get("method")] += us_since(start) / 60e6;
    return errors;
  }

  void run_method(const Problem& problem, const Specimen& specimen, const BaseSheet& base, Worker& worker, Record row,
                  const Yardstick& yardstick) {
    const auto start = Clock::now();
    worker.forget_base();
    const CutRun cut = worker.measure(base, specimen.cuts, cut_options_, false);
    fill(row, {.cut = &cut});
    row.set("exact_incision", std::int64_t{worker.variant.row->promises.exact_incision});
    row.set("cut_us", cut.time_us.total());
    bool solvable = cut.status != Status::failed && cut.status != Status::refused;
    if (solvable) {
      const Variant& v = worker.variant;
      const Judgement judgement = judge_one_by_one(base.sheet, worker.sheet, specimen.cuts, v.row->promises,
                                                   v.row->make(v.parameter), cut_options_);
      const Assessment a = assess(base.sheet, worker.sheet, judgement, {});
      set_assessment(row, &cut, a, base);
      solvable = a.judgement.ok;
    }
    const bool takes_them = (worker.constraints.constraints.empty() || problem.takes_constraints()) &&
                            (!worker.constraints.merge_triangles() || problem.takes_compounds());
    if (solvable && !takes_them) {
      row.set("status", std::string(name_of(Status::refused)));
      row.set("reason", std::string("vertices are constrained or triangles merged, which the problem does not take"));
      solvable = false;
    }
    answer(problem, specimen, solvable ? &worker.sheet : nullptr, worker.constraints, row, yardstick);
    minutes_[AccuracySummary::label(row.get("method"), row.get("parameter"))] += us_since(start) / 60e6;
  }

  static void set_failure(Record& row, const std::string& status, const std::string& verdict, const std::string& why) {
    row.set("status", status);
    row.set("verdict", verdict);
    row.set("reason", why);
  }

  static void set_assessment(Record& row, const CutRun* cut, const Assessment& a, const BaseSheet& base) {
    fill(row, {.h = base.sheet.mean_edge(), .cut = cut, .judged = true, .assessment = &a});
    row.set("triangles", to_int64(base.sheet.triangle_count()) + a.triangles_added);
  }

  /// A row per budget. `sheet`: null where there is nothing to solve, which the row says already. Returns the errors of
  /// the first direct solve.
  Yardstick answer(const Problem& problem, const Specimen& specimen, const Sheet* sheet, const Constraints& constraints,
                   Record& row, const Yardstick& yardstick) {
    const std::vector<Budget>& budgets = budgets_for(problem);
    std::vector<Answer> answers;
    try {
      if (sheet) answers = problem.answer(specimen, *sheet, budgets, constraints);
    } catch (const std::exception& error) {
      set_failure(row, row.get("status"), name_of(Verdict::crashed), error.what());
    }
    Yardstick errors;
    if (!answers.empty() && answers.front().verdict == Verdict::ok)
      for (const Measure& m : answers.front().measures) errors[m.name] = m.error;
    const bool is_reference = row.get("method") == reference_method;
    for (std::size_t b = 0; b < budgets.size(); ++b) {
      Record full = row;
      set_budget(full, budgets[b]);
      if (b < answers.size()) set_answer(full, answers[b], is_reference ? errors : yardstick);
      if (!file_.has(full)) file_.append(full);
    }
    return errors;
  }

  static void set_answer(Record& row, const Answer& answer, const Yardstick& yardstick) {
    if (answer.refused) {
      row.set("status", std::string(name_of(Status::refused)));
      row.set("reason", answer.reason);
      return;
    }
    row.set("unknowns", to_int64(answer.unknowns));
    row.set("assemble_us", answer.assemble_us);
    row.set("setup_us", answer.setup_us);
    row.set("solve_us", answer.solve_us);
    row.set("total_us", std::stod(row.get("cut_us")) + answer.assemble_us + answer.setup_us + answer.solve_us);
    row.set("iterations", std::int64_t{answer.iterations});
    row.set("residual", answer.residual);
    row.set("verdict", std::string(name_of(answer.verdict)));
    row.set("reason", answer.reason);
    if (answer.verdict != Verdict::ok) return;
    for (const Measure& m : answer.measures) {
      const auto reference = yardstick.find(m.name);
      const bool measurable = reference != yardstick.end() && reference->second > exact_to_rounding;
      const double excess = measurable ? m.error / reference->second - 1 : 0;
      row.set("value_" + m.name, m.value);
      row.set("exact_" + m.name, m.exact);
      row.set("error_" + m.name, m.error);
      if (measurable) row.set("excess_" + m.name, excess);
      if (m.name != row.get("primary")) continue;
      row.set("error", m.error);
      if (measurable) row.set("excess_error", excess);
    }
  }

  const AccuracyStudy& plan_;
  AccuracySummary summary_;
  CutOptions cut_options_;
  std::vector<Worker> workers_;
  std::vector<Budget> direct_, budgets_;  // budgets_: the direct ones first
  std::map<std::string, double> minutes_;
};

}  // namespace

const std::vector<std::string>& accuracy_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names = record_columns("problem", accuracy_metrics()), measures;
    for (const auto& problem : all_problems())
      for (const std::string& measure : problem->measures())
        if (std::find(measures.begin(), measures.end(), measure) == measures.end()) measures.push_back(measure);
    measures.insert(measures.end(), tip_measures.begin(), tip_measures.end());
    for (const std::string& measure : measures)
      for (const char* kind : {"value_", "exact_", "error_", "excess_"}) names.push_back(kind + measure);
    return names;
  }();
  return columns;
}

bool run_accuracy(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                  const RunOptions& options) {
  return AccuracyRun(experiment, std::get<AccuracyStudy>(experiment.study), methods, context, options).run();
}

}  // namespace cutbench
