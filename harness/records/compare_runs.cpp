#include "harness/records/compare_runs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/files/whole_file.h"
#include "harness/records/metrics.h"
#include "harness/records/record.h"

namespace cutbench {

namespace {

struct Run {
  std::vector<std::string> columns;
  std::map<std::string, std::vector<std::string>> rows;  // by the fields that say what was measured
  std::map<std::string, std::string> tools;

  std::ptrdiff_t column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    return found == columns.end() ? -1 : found - columns.begin();
  }
};

Run read_run(const std::filesystem::path& folder) {
  Run run;
  std::istringstream lines(text_of((folder / "records.csv").string()));
  std::string line;
  std::getline(lines, line);
  run.columns = fields_of(line);
  if (run.columns.size() <= key_columns || run.column("method") < 0)
    throw InputError((folder / "records.csv").string() +
                     ": line 1 is no head of records; give a folder of cutbench run");
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    std::vector<std::string> fields = fields_of(line);
    if (fields.size() != run.columns.size())
      throw InputError((folder / "records.csv").string() + ": line " + std::to_string(number) + " has " +
                       std::to_string(fields.size()) + " fields, not " + std::to_string(run.columns.size()) +
                       "; run the experiment again");
    std::string key;
    for (std::size_t k = 0; k < key_columns; ++k) key += (k ? "," : "") + fields[k];
    run.rows[key] = std::move(fields);
  }
  try {
    const auto json = nlohmann::json::parse(text_of((folder / "context.json").string()));
    for (const char* const name : {"compiler", "flags", "build_type", "cpu"}) run.tools[name] = json.at(name);
    for (const auto& [library, version] : json.at("versions").items()) run.tools[library] = version;
  } catch (const nlohmann::json::exception& error) {
    throw InputError((folder / "context.json").string() + ": " + error.what() + "; run the experiment again");
  }
  return run;
}

std::string why_not(const Run& base, const Run& head, std::size_t common) {
  for (const auto& [name, value] : base.tools)
    if (const auto found = head.tools.find(name); found == head.tools.end() || found->second != value)
      return name + " is \"" + value + "\" in the base and \"" +
             (found == head.tools.end() ? "nothing" : found->second) + "\" in the head";
  if (common == 0) return "no row is in both; run both with the same --seed";
  for (const auto& [key, fields] : base.rows)
    if (!head.rows.contains(key)) return "the head has no row " + key;
  return {};
}

/// NaN where it was not measured.
double value_of(const std::string& field) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  return *end == 0 ? value : std::numeric_limits<double>::quiet_NaN();
}

class Pairs {
 public:
  Pairs(const Run& base, const Run& head) : base_(base), head_(head) {}

  template <class Visit>
  void for_each(const std::string& column, const Visit& visit) const {
    const auto mine = base_.column(column), theirs = head_.column(column);
    if (mine < 0 || theirs < 0) return;
    for (const auto& [key, fields] : base_.rows) {
      const auto found = head_.rows.find(key);
      if (found != head_.rows.end()) visit(key, fields, fields[to_size(mine)], found->second[to_size(theirs)]);
    }
  }
  /// Method and parameter.
  std::string method(const std::vector<std::string>& fields) const {
    const auto parameter = base_.column("parameter");
    const std::string name = fields[to_size(base_.column("method"))];
    return parameter < 0 || fields[to_size(parameter)].empty() ? name : name + " " + fields[to_size(parameter)];
  }
  /// The row without its repetition.
  std::string case_of(std::vector<std::string> fields) const {
    if (const auto r = base_.column("repetition"); r >= 0) fields[to_size(r)].clear();
    std::string text;
    for (std::size_t k = 0; k < key_columns; ++k) text += fields[k] + ',';
    return text;
  }

 private:
  const Run& base_;
  const Run& head_;
};

void compare_times(const Pairs& pairs, const std::string& column, double most, RunComparison& result) {
  std::map<std::string, std::map<std::string, std::pair<double, int>>> logs;  // by method and case: sum and number
  pairs.for_each(column,
                 [&](const std::string&, const auto& fields, const std::string& before, const std::string& after) {
                   const double ratio = value_of(after) / value_of(before);
                   if (!(ratio > 0) || !std::isfinite(ratio)) return;
                   auto& [sum, number] = logs[pairs.method(fields)][pairs.case_of(fields)];
                   sum += std::log(ratio);
                   ++number;
                 });
  for (const auto& [method, cases] : logs) {
    std::vector<double> means;
    for (const auto& [name, log] : cases) means.push_back(std::exp(log.first / log.second));
    std::sort(means.begin(), means.end());
    const auto [low, high] = median_ranks(means.size());
    TimeRatio ratio{.method = method,
                    .column = column,
                    .cases = means.size(),
                    .median = means[means.size() / 2],
                    .low = means[low],
                    .high = means[high]};
    if (ratio.cases >= fewest_cases) {
      ratio.shown = most * ratio.median / ratio.low;  // the interval of a sheer slow-down is as wide as this one
      ratio.slower = ratio.low > most;
      ratio.faster = ratio.high < 1 / most;
    }
    result.times.push_back(ratio);
  }
}

void compare_quality(const Pairs& pairs, const Metric& metric, RunComparison& result) {
  std::map<std::string, QualityChange> by_method;
  pairs.for_each(metric.name,
                 [&](const std::string&, const auto& fields, const std::string& before, const std::string& after) {
                   QualityChange& change = by_method[pairs.method(fields)];
                   ++change.rows;
                   if (before == after) return;
                   const double a = value_of(before), b = value_of(after);
                   const bool better = metric.direction == Direction::lower ? b < a : b > a;
                   ++(better ? change.better : change.worse);  // what can no longer be measured is worse
                 });
  for (auto& [method, change] : by_method) {
    change.method = method;
    change.column = metric.name;
    if (change.better + change.worse > 0) result.quality.push_back(change);
  }
}

std::string in_percent(double ratio) {
  char text[32];
  std::snprintf(text, sizeof text, "%+.1f %%", 100 * (ratio - 1));
  return text;
}

std::string verdict_of(const TimeRatio& t) {
  return t.slower ? "slower" : t.faster ? "faster" : t.shown > 0 ? "-" : "too few cases";
}

std::string shown_by(const TimeRatio& t) { return t.shown > 0 ? in_percent(t.shown) : "none"; }

/// The smallest and the largest change that a time could have shown.
std::string shown_at_all(const RunComparison& c) {
  std::vector<double> shown;
  for (const TimeRatio& t : c.times)
    if (t.shown > 0) shown.push_back(t.shown);
  if (shown.empty()) return {};
  const auto [least, most] = std::minmax_element(shown.begin(), shown.end());
  return "with these cases a slow-down of " + in_percent(*least) +
         (*most > *least ? " to " + in_percent(*most) + ", by method and time," : std::string()) +
         " would have been found";
}

std::string first_line(const RunComparison& c) {
  if (!c.not_comparable.empty()) return "not comparable: " + c.not_comparable;
  std::size_t slower = 0, faster = 0;
  for (const TimeRatio& t : c.times) {
    slower += t.slower;
    faster += t.faster;
  }
  std::string text = slower ? "SLOWER: " + std::to_string(slower) + " times" : "nothing slower";
  text += " of " + std::to_string(c.times.size()) + ", " + std::to_string(faster) + " faster; ";
  if (c.has_too_few_cases())
    text = "too few cases to say that nothing is slower: " + std::to_string(fewest_cases) + " are needed; ";
  text += std::to_string(c.worse.size()) + " verdicts worse; " + std::to_string(c.quality.size()) +
          " quality columns changed; " + std::to_string(c.rows) + " rows";
  return text;
}

std::string cells(const TimeRatio& t, const char* between) {
  return t.method + between + t.column + between + in_percent(t.median) + between + "[" + in_percent(t.low) + ", " +
         in_percent(t.high) + "]" + between + std::to_string(t.cases) + between + shown_by(t) + between + verdict_of(t);
}

std::string cells(const QualityChange& q, const char* between) {
  return q.method + between + q.column + between + std::to_string(q.better) + between + std::to_string(q.worse) +
         between + std::to_string(q.rows);
}

}  // namespace

std::pair<std::size_t, std::size_t> median_ranks(std::size_t n) {
  if (n == 0) return {0, 0};
  // The number of values below the median is binomial(n, 1/2): take off both ends what has at most 2.5 % each.
  double term = std::exp2(-to_double(n)), below = term;
  if (n > 1000) {  // the powers of 2 end; so does the difference to the normal distribution
    const double middle = to_double(n) / 2, half = 0.98 * std::sqrt(to_double(n));
    const auto low = to_size(middle - half);
    return {low, n - 1 - low};
  }
  std::size_t low = 0;
  for (std::size_t k = 1; k <= n / 2; ++k) {
    term *= to_double(n - k + 1) / to_double(k);
    if (below > 0.025) break;
    low = k - 1;
    below += term;
  }
  return {low, n - 1 - low};
}

bool RunComparison::is_slower() const {
  return !worse.empty() || std::any_of(times.begin(), times.end(), [](const TimeRatio& t) { return t.slower; });
}

bool RunComparison::has_too_few_cases() const {
  return !times.empty() && std::all_of(times.begin(), times.end(), [](const TimeRatio& t) { return t.shown == 0; });
}

RunComparison compare_runs(const std::filesystem::path& base, const std::filesystem::path& head, double times) {
  const Run before = read_run(base), after = read_run(head);
  RunComparison result;
  result.base = base.string();
  result.head = head.string();
  for (const auto& [key, fields] : before.rows) result.rows += after.rows.contains(key);
  result.not_comparable = why_not(before, after, result.rows);
  if (!result.not_comparable.empty()) return result;
  const Pairs pairs(before, after);
  for (const char* const column : {"status", "verdict"})
    pairs.for_each(column, [&](const std::string& key, const auto&, const std::string& was, const std::string& is) {
      if (was == "ok" && is != "ok") result.worse.push_back({key, column + std::string(" ok"), is});
    });
  for (const Metric& metric : all_metrics()) {
    if (metric.direction == Direction::none) continue;
    if (metric.group == Group::time || metric.group == Group::step)
      compare_times(pairs, metric.name, times, result);
    else
      compare_quality(pairs, metric, result);
  }
  std::stable_sort(result.times.begin(), result.times.end(), [](const TimeRatio& a, const TimeRatio& b) {
    return std::pair(!a.slower, -a.median) < std::pair(!b.slower, -b.median);
  });
  return result;
}

std::string as_text(const RunComparison& c) {
  std::ostringstream out;
  out << first_line(c) << "\nbase " << c.base << "; head " << c.head << '\n';
  if (const std::string shown = shown_at_all(c); !shown.empty()) out << shown << '\n';
  for (const WorseVerdict& w : c.worse) out << "  " << w.row << ": " << w.before << ", now " << w.after << '\n';
  if (!c.times.empty()) out << "  method  time  change  95 %  cases  would show\n";
  for (const TimeRatio& t : c.times) out << "  " << cells(t, "  ") << '\n';
  if (!c.quality.empty()) out << "  method  quality  rows better  worse  of\n";
  for (const QualityChange& q : c.quality) out << "  " << cells(q, "  ") << '\n';
  return out.str();
}

std::string as_markdown(const RunComparison& c) {
  std::ostringstream out;
  out << "**" << first_line(c) << "**\n\nBase " << c.base << ", head " << c.head << ".\n\n";
  if (const std::string shown = shown_at_all(c); !shown.empty()) out << "With" << shown.substr(4) << ".\n\n";
  for (const WorseVerdict& w : c.worse) out << "- " << w.row << ": " << w.before << ", now " << w.after << '\n';
  if (!c.times.empty())
    out << "\n| method | time | change | 95 % | cases | would show | verdict |\n|---|---|---|---|---|---|---|\n";
  for (const TimeRatio& t : c.times) out << "| " << cells(t, " | ") << " |\n";
  if (!c.quality.empty()) out << "\n| method | quality | rows better | worse | of |\n|---|---|---|---|---|\n";
  for (const QualityChange& q : c.quality) out << "| " << cells(q, " | ") << " |\n";
  return out.str();
}

std::string as_json(const RunComparison& c) {
  nlohmann::ordered_json json{{"verdict", !c.not_comparable.empty() ? "not_comparable"
                                          : c.is_slower()           ? "slower"
                                          : c.has_too_few_cases()   ? "too_few_cases"
                                                                    : "ok"},
                              {"not_comparable", c.not_comparable},
                              {"base", c.base},
                              {"head", c.head},
                              {"rows", c.rows},
                              {"times", nlohmann::ordered_json::array()},
                              {"quality", nlohmann::ordered_json::array()},
                              {"worse", nlohmann::ordered_json::array()}};
  for (const TimeRatio& t : c.times)
    json["times"].push_back({{"method", t.method},
                             {"column", t.column},
                             {"cases", t.cases},
                             {"median", t.median},
                             {"interval", {t.low, t.high}},
                             {"would_show", t.shown > 0 ? nlohmann::ordered_json(t.shown) : nullptr},
                             {"verdict", verdict_of(t)}});
  for (const QualityChange& q : c.quality)
    json["quality"].push_back(
        {{"method", q.method}, {"column", q.column}, {"rows", q.rows}, {"better", q.better}, {"worse", q.worse}});
  for (const WorseVerdict& w : c.worse) json["worse"].push_back({{"row", w.row}, {"was", w.before}, {"is", w.after}});
  return json.dump(1) + "\n";
}

}  // namespace cutbench
