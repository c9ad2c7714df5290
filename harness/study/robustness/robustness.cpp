#include "harness/study/robustness/robustness.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "harness/base/conversions.h"
#include "harness/cases/adversarial.h"
#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "harness/processes/isolated.h"
#include "harness/records/metrics.h"
#include "harness/study/robustness/failing_case.h"
#include "harness/study/robustness/robustness_case.h"
#include "harness/study/robustness/robustness_summary.h"
#include "harness/study/study_run.h"

namespace cutbench {

namespace {

constexpr std::size_t saved_per_row = 20, saved_per_row_of_cross_check = 1;
constexpr double shrinking_s = 10;
constexpr double near = 1e-9;  // mean edges: nearer than this, an event is near

/// What is known of a case before a contender cuts it.
struct Drawn {
  std::int32_t family = 0;  // 1 + its number; 0: drawing the case crashed or hung
  bool near_event = false;
};

class RobustnessRun : public StudyRun {
 public:
  RobustnessRun(const Experiment& experiment, const RobustnessStudy& plan, const std::vector<MethodRow>& methods,
                const Context& context, const RunOptions& options)
      : StudyRun(experiment, context, options, robustness_columns()),
        plan_(plan),
        folder_(std::filesystem::path(options.out) / experiment.stem) {
    for (const Variant& v : variants_of(experiment, methods)) contenders_.push_back(contender_of(v));
    if (plan_.cross_check) contenders_.push_back(cgal_check());
    cut_options_.chord_tolerance = experiment.chord_tolerance;
    families_.emplace_back("unknown");  // of a case whose drawing crashed or hung
    for (const char* family : adversarial_families()) families_.emplace_back(family);
  }

 private:
  std::size_t case_count() override {
    const std::size_t sheets = experiment_.sized_sheets().size() + plan_.mesh_files.size();
    const std::size_t ours = options_.ours(0, sheets * to_size(plan_.cases)).size();
    return ours * contenders_.size();
  }

  void run_cases(Progress& progress) override {
    for (const auto& [sheet, resolution] : experiment_.sized_sheets())
      run_sheet(sheet, make_sheet(sheet, squares_per_side(resolution)), progress);
    for (const auto& file : plan_.mesh_files) run_sheet(file.stem().string(), read_mesh(file), progress);
  }

  void add_row(const Record& row, RightResults& results) override {
    RobustnessSummary::Row& sum = summary_.add();
    sum.family = row.get("cut_family");
    sum.sheet = row.get("sheet") + " " + row.get("resolution");
    sum.method = row.get("method") + (row.get("parameter").empty() ? "" : " " + row.get("parameter"));
    sum.ours = std::any_of(contenders_.begin(), contenders_.end(),
                           [&](const Contender& c) { return c.variant && c.method == row.get("method"); });
    for (std::size_t c = 0; c < count_names.size(); ++c) sum.count[c] = std::stoll(row.get(count_names[c]));
    const std::int64_t right = sum.count[Count::ok] + sum.count[Count::deviated];
    const auto why = last_reason_.find(row.get("method"));  // as far as this process knows
    results.add(row.get("method"), right, sum.count[Count::tried] - sum.count[Count::noop] - right,
                why == last_reason_.end() ? "" : why->second);
  }
  void print_summary() const override { summary_.print(experiment_.stem, experiment_.seed); }
  bool all_ok() const override { return summary_.all_ok(); }

  void run_sheet(const std::string& name, const MeshData& mesh, Progress& progress) {
    sheet_name_ = name;
    mesh_ = mesh;
    sheet_ = Sheet(mesh);
    drawn_.clear();
    numbers_ = next_ours(to_size(plan_.cases));
    for (const Contender& contender : contenders_) {
      if (is_done(contender)) {
        progress.skip(numbers_.size());
        continue;
      }
      if (drawn_.empty()) draw();
      run_contender(contender, progress);
      progress.step(numbers_.size());
    }
  }

  Record start_row(const Contender& contender, const std::string& family) const {
    Record row =
        StudyRun::start_row(sheet_name_, to_int64(sheet_.triangle_count()), contender.method, contender.parameter);
    row.set("cut_family", family);
    return row;
  }

  bool is_done(const Contender& contender) const {
    return std::all_of(families_.begin() + 1, families_.end(),
                       [&](const std::string& family) { return file_.has(start_row(contender, family)); });
  }

  AdversarialCase adversarial_case(std::size_t k) const {
    return make_adversarial_case(experiment_.seed, numbers_[k], sheet_);
  }

  /// Draws the cases of a sheet, which are the same for all contenders.
  void draw() {
    run_apart<Drawn>(
        numbers_.size(), plan_.time_limit_s,
        [&](std::size_t k, Drawn& drawn) {
          const AdversarialCase c = adversarial_case(k);
          const auto family = std::find(families_.begin() + 1, families_.end(), c.family);
          drawn.near_event = nearest_event(c.cuts, sheet_) < near;
          drawn.family = to_int32(family - families_.begin());
        },
        [&](std::size_t, const Drawn& drawn, Fate) { drawn_.push_back(drawn); });
  }

  /// Of one contender on the sheet under way, by family.
  struct Sums {
    explicit Sums(std::size_t families) : counts(families, Counts{}), slowest_us(families, 0), saved(families, 0) {}
    std::vector<Counts> counts;
    std::vector<double> slowest_us;
    std::vector<std::size_t> saved;
    std::vector<FailingCase> failing;  // of all families
  };

  void run_contender(const Contender& contender, Progress& progress) {
    Sums sums(families_.size());
    run_apart<CaseResult>(
        numbers_.size(), plan_.time_limit_s,
        [&](std::size_t k, CaseResult& result) {
          try_case(contender, sheet_, adversarial_case(k).cuts, cut_options_, result);
        },
        [&](std::size_t k, const CaseResult& result, Fate fate) { add_case(contender, k, result, fate, sums); },
        [&](std::size_t begun) { progress.show(begun); });
    save_all(contender, sums.failing);
    for (std::size_t family = 0; family < families_.size(); ++family) {
      if (family == 0 && sums.counts[family][Count::cases] == 0) continue;
      Record row = start_row(contender, families_[family]);
      if (file_.has(row)) continue;
      for (std::size_t c = 0; c < count_names.size(); ++c) row.set(count_names[c], sums.counts[family][c]);
      row.set("slowest_us", sums.slowest_us[family]);
      file_.append(row);
    }
  }

  void add_case(const Contender& contender, std::size_t k, const CaseResult& result, Fate fate, Sums& sums) {
    const auto family = to_size(drawn_[k].family);
    const Fault fault = fault_of(result, fate);
    Counts count = result.count;
    if (fate != Fate::done) ++count[fault.kind];
    count[Count::tried] = std::max<std::int64_t>(1, count[Count::tried]);  // it may have crashed before its first cut
    count[Count::cases] = 1;
    count[Count::near_event_cases] = drawn_[k].near_event;
    Counts& sum = sums.counts[family];
    std::transform(count.begin(), count.end(), sum.begin(), sum.begin(), std::plus<>());
    if (fault.kind != Count::ok)
      last_reason_[contender.method] = fault.text();
    else if (result.refusal.front() != 0)
      last_reason_[contender.method] = std::string("refused: ") + result.refusal.data();
    sums.slowest_us[family] = std::max(sums.slowest_us[family], result.slowest_us);
    if (fault.kind != Count::ok && family > 0 &&
        sums.saved[family]++ < (contender.variant ? saved_per_row : saved_per_row_of_cross_check))
      sums.failing.push_back(failing_case(contender, k, fault));
  }

  FailingCase failing_case(const Contender& contender, std::size_t k, const Fault& fault) const {
    const AdversarialCase c = adversarial_case(k);
    const std::string sheet = sheet_name_ + std::to_string(sheet_.triangle_count());
    const std::string number = std::to_string(numbers_[k]);
    std::string name =
        sheet + "-" + contender.method + (contender.parameter.empty() ? "" : "-" + contender.parameter) + "-" + number;
    std::erase_if(name, [](char letter) { return letter == '(' || letter == ')' || letter == '=' || letter == ' '; });
    return {name,
            experiment_.stem + ", seed " + std::to_string(experiment_.seed) + ", case " + number + " (" + c.family +
                ") on " + sheet + " by " + contender.method + " " + contender.parameter,
            {mesh_, c.cuts},
            fault};
  }

  /// In child processes too: making a case small takes many trials, each of which may crash.
  void save_all(const Contender& contender, const std::vector<FailingCase>& failing) const {
    if (failing.empty()) return;
    const auto folder = folder_ / "failing";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    const auto fates = run_isolated(
        failing.size(), {options_.workers, 60 + 20 * plan_.time_limit_s},
        [&](std::size_t f) { save(failing[f], folder, contender, cut_options_, plan_.time_limit_s, shrinking_s); });
    if (std::any_of(fates.begin(), fates.end(), [](Fate fate) { return fate != Fate::done; }))
      throw InputError(folder.string() + ": failing cases can't be written; check that it may be written and has room");
  }

  const RobustnessStudy& plan_;
  std::filesystem::path folder_;
  RobustnessSummary summary_;
  CutOptions cut_options_;
  std::vector<Contender> contenders_;
  std::vector<std::string> families_;
  std::map<std::string, std::string> last_reason_;  // by method: of what was refused or is wrong
  // Of the sheet under way.
  std::string sheet_name_;
  std::vector<std::size_t> numbers_;  // of the shard's cases
  MeshData mesh_;
  Sheet sheet_;
  std::vector<Drawn> drawn_;
};

}  // namespace

const std::vector<std::string>& robustness_columns() {
  static const std::vector<std::string> columns = record_columns("cut_family", robustness_metrics());
  return columns;
}

bool run_robustness(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options) {
  return RobustnessRun(experiment, std::get<RobustnessStudy>(experiment.study), methods, context, options).run();
}

}  // namespace cutbench
