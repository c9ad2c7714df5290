#include "harness/study/robustness/robustness_summary.h"

#include <algorithm>
#include <cstdio>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

void add_to(Counts& sum, const Counts& more) {
  std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus<>());
}

double percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * to_double(part) / to_double(whole) : 0;
}

using Sums = std::vector<std::pair<std::string, Counts>>;  // in order of appearance

Counts& sum_of(Sums& sums, const std::string& name) {
  const auto found = std::find_if(sums.begin(), sums.end(), [&](const auto& s) { return s.first == name; });
  return found != sums.end() ? found->second : sums.emplace_back(name, Counts{}).second;
}

void print_sums(const char* by, const Sums& sums) {
  std::printf("%-28s", by);
  for (int c = Count::tried; c <= Count::carefully; ++c) std::printf(" %9s", count_names[to_size(c)]);
  std::printf("  near cases\n");
  for (const auto& [name, count] : sums) {
    std::printf("%-28s", name.c_str());
    for (int c = Count::tried; c <= Count::carefully; ++c)
      std::printf(" %9lld", static_cast<long long>(count[to_size(c)]));
    std::printf(" %9.1f %%\n", percent(count[Count::near_event_cases], count[Count::cases]));
  }
}

}  // namespace

bool RobustnessSummary::all_ok() const {
  return std::none_of(rows_.begin(), rows_.end(), [](const Row& r) { return r.ours && faults_in(r.count) > 0; });
}

void RobustnessSummary::print(const std::string& stem, std::uint64_t seed) const {
  Sums methods, sheets, families;
  Counts ours{};
  for (const Row& row : rows_) {
    add_to(sum_of(methods, row.method), row.count);
    if (!row.ours) continue;
    add_to(sum_of(sheets, row.sheet), row.count);
    add_to(sum_of(families, row.family), row.count);
    add_to(ours, row.count);
  }
  std::printf("\n%s: cuts by what came of them\n", stem.c_str());
  print_sums("method", methods);
  print_sums("sheet (without the cross-check)", sheets);
  print_sums("family (without the cross-check)", families);
  const std::int64_t good = ours[Count::tried] - faults_in(ours);
  std::printf(
      "%lld of %lld cuts ok, noop, deviated or refused, in %lld cases drawn from make_adversarial_case, seed %llu\n",
      static_cast<long long>(good), static_cast<long long>(ours[Count::tried]),
      static_cast<long long>(ours[Count::cases]), static_cast<unsigned long long>(seed));
  std::printf("%.1f %% of the cases have an event nearer than 1e-9 mean edges\n",
              percent(ours[Count::near_event_cases], ours[Count::cases]));
}

}  // namespace cutbench
