#include "harness/study/accuracy_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// A failed row counts as infinitely bad.
double median(std::vector<double> values, std::size_t failed) {
  values.resize(values.size() + failed, std::numeric_limits<double>::infinity());
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + to_index((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void AccuracySummary::add(const Record& row) {
  const std::string method = label(row.get("method"), row.get("parameter"));
  if (std::find(methods_.begin(), methods_.end(), method) == methods_.end()) methods_.push_back(method);
  const std::string solver = row.get("solver") + (row.get("tip_functions") == "1" ? " + tips" : "");
  Group& group = groups_[{method, solver, std::stoi(row.get("budget"))}];
  ++group.rows;
  group.refused += row.get("status") == "refused";
  if (row.get("verdict") != "ok" || row.get("error").empty()) {
    ++group.failed;
    all_ok_ = false;
    return;
  }
  group.total_us.push_back(std::stod(row.get("total_us")));
  if (!row.get("excess_error").empty()) group.excess.push_back(std::stod(row.get("excess_error")));
}

void AccuracySummary::print(const std::string& title, const std::map<std::string, double>& minutes) const {
  std::printf("\n%s: medians over problems, sheets, resolutions and members; a failed row counts as infinitely bad\n",
              title.c_str());
  std::printf("%-28s %-18s %10s %7s %7s %7s %14s %10s\n", "method", "solver", "iterations", "rows", "refused", "failed",
              "excess error %", "total ms");
  for (const std::string& method : methods_)
    for (const auto& [key, group] : groups_) {
      const auto& [name, solver, budget] = key;
      if (name != method) continue;
      char excess[32] = "-";  // none without the mesh fitted to the cut
      if (!group.excess.empty()) std::snprintf(excess, sizeof excess, "%.3g", 100 * median(group.excess, group.failed));
      std::printf("%-28s %-18s %10s %7zu %7zu %7zu %14s %10.4g\n", method.c_str(), solver.c_str(),
                  budget > 0 ? std::to_string(budget).c_str() : "till solved", group.rows, group.refused,
                  group.failed - group.refused, excess, median(group.total_us, group.failed) / 1000);
    }
  for (const auto& [method, spent] : minutes) std::printf("%-28s %.2f minutes\n", method.c_str(), spent);
  std::fflush(stdout);  // before the next run's progress, which goes to stderr
}

}  // namespace cutbench
