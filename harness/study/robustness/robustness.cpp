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
#include "harness/study/study.h"

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

class Robustness : public Study {
 public:
  Robustness(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
             const RunOptions& options)
      : Study(experiment, context, options, {.columns = robustness_columns(), .with_times = false}),
        plan_(*experiment.robustness),
        folder_(std::filesystem::path(options.out) / experiment.stem),
        isolation_{options.workers, plan_.time_limit_s} {
    for (const Variant& v : variants_of(experiment, methods)) contenders_.push_back(contender_of(v));
    if (plan_.cross_check) contenders_.push_back(cgal_check());
    cut_options_.chord_tolerance = experiment.chord_tolerance;
    families_.emplace_back("unknown");  // of a case whose drawing crashed or hung
    for (const char* family : adversarial_families()) families_.emplace_back(family);
  }

 private:
  std::size_t case_count() override {
    const std::size_t sheets = experiment_.sheets.size() * experiment_.resolutions.size() + plan_.mesh_files.size();
    const std::size_t ours = options_.ours(0, sheets * to_size(experiment_.cases)).size();
    return ours * contenders_.size();
  }

  void run_cases(Progress& progress) override {
    for (const auto& sheet : experiment_.sheets)
      for (int resolution : experiment_.resolutions)
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
    numbers_ = options_.ours(items_, to_size(experiment_.cases));
    items_ += to_size(experiment_.cases);
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
    Record row(robustness_columns());
    row.set("suite_version", std::string(suite_version));
    row.set("cut_family", family);
    row.set("sheet", sheet_name_);
    row.set("method", contender.method);
    row.set("parameter", contender.parameter);
    row.set("resolution", to_int64(sheet_.triangle_count()));
    row.set("seed", to_int64(experiment_.seed));
    return row;
  }

  bool is_done(const Contender& contender) const {
    return std::all_of(families_.begin() + 1, families_.end(),
                       [&](const std::string& family) { return file_.has(start_row(contender, family).key()); });
  }

  AdversarialCase adversarial_case(std::size_t k) const {
    return make_adversarial_case(experiment_.seed, numbers_[k], sheet_);
  }

  /// Draws the cases of a sheet, which are the same for all contenders.
  void draw() {
    const SharedArray<Drawn> drawn(numbers_.size());
    run_isolated(numbers_.size(), isolation_, [&](std::size_t k) {
      const AdversarialCase c = adversarial_case(k);
      const auto family = std::find(families_.begin() + 1, families_.end(), c.family);
      drawn[k].near_event = nearest_event(c.cuts, sheet_) < near;
      drawn[k].family = to_int32(family - families_.begin());
    });
    for (std::size_t k = 0; k < numbers_.size(); ++k) drawn_.push_back(drawn[k]);
  }

  void run_contender(const Contender& contender, Progress& progress) {
    const SharedArray<CaseResult> results(numbers_.size());
    const auto fates = run_isolated(
        numbers_.size(), isolation_,
        [&](std::size_t k) { try_case(contender, sheet_, adversarial_case(k).cuts, cut_options_, results[k]); },
        [&](std::size_t begun) { progress.show(begun); });

    std::vector<Counts> sums(families_.size(), Counts{});
    std::vector<double> slowest(families_.size(), 0);
    std::vector<std::size_t> saved(families_.size(), 0);
    std::vector<FailingCase> failing;
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      const auto family = to_size(drawn_[k].family);
      const Fault fault = fault_of(results[k], fates[k]);
      Counts count = results[k].count;
      if (fates[k] != Fate::done) ++count[fault.kind];
      count[Count::tried] = std::max<std::int64_t>(1, count[Count::tried]);  // it may have crashed before its first cut
      count[Count::cases] = 1;
      count[Count::near_event_cases] = drawn_[k].near_event;
      std::transform(count.begin(), count.end(), sums[family].begin(), sums[family].begin(), std::plus<>());
      if (fault.kind != Count::ok)
        last_reason_[contender.method] = fault.text();
      else if (results[k].refusal.front() != 0)
        last_reason_[contender.method] = std::string("refused: ") + results[k].refusal.data();
      slowest[family] = std::max(slowest[family], results[k].slowest_us);
      if (fault.kind != Count::ok && family > 0 &&
          saved[family]++ < (contender.variant ? saved_per_row : saved_per_row_of_cross_check))
        failing.push_back(failing_case(contender, k, fault));
    }
    save_all(contender, failing);
    for (std::size_t family = 0; family < families_.size(); ++family) {
      if (family == 0 && sums[family][Count::cases] == 0) continue;
      Record row = start_row(contender, families_[family]);
      if (file_.has(row.key())) continue;
      for (std::size_t c = 0; c < count_names.size(); ++c) row.set(count_names[c], sums[family][c]);
      row.set("slowest_us", slowest[family]);
      file_.append(row);
    }
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

  const Experiment::Robustness& plan_;
  std::filesystem::path folder_;
  RobustnessSummary summary_;
  Isolation isolation_;
  CutOptions cut_options_;
  std::vector<Contender> contenders_;
  std::vector<std::string> families_;
  std::map<std::string, std::string> last_reason_;  // by method: of what was refused or is wrong
  std::size_t items_ = 0;                           // cases of the sheets so far, of all shards
  // Of the sheet under way.
  std::string sheet_name_;
  std::vector<std::size_t> numbers_;  // of the shard's cases
  MeshData mesh_;
  Sheet sheet_;
  std::vector<Drawn> drawn_;
};

}  // namespace

const std::vector<std::string>& robustness_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names = key_column_names();
    const std::vector<std::string> counts = columns_of({Group::robustness});
    names.insert(names.end(), counts.begin(), counts.end());
    return names;
  }();
  return columns;
}

bool run_robustness(const Experiment& experiment, const std::vector<MethodRow>& methods, const Context& context,
                    const RunOptions& options) {
  return Robustness(experiment, methods, context, options).run();
}

}  // namespace cutbench
