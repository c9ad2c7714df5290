// Two folders of `cutbench run`, cut by cut: times as paired ratios, quality columns that changed, verdicts that got
// worse.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cutbench {

/// Head over base of one time column, by method: the median over cases of the geometric mean over their repetitions.
struct TimeRatio {
  std::string method, column;
  std::size_t cases = 0;
  double median = 1, low = 1, high = 1;  ///< [low, high] covers the true median in 95 % (order statistics)
  double shown = 0;                      ///< a slow-down by this ratio would have been found; 0: too few cases for any
  bool slower = false, faster = false;
};

/// With fewer cases no interval covers the median in 95 %: nothing is said of them, not even that they are equal.
constexpr std::size_t fewest_cases = 6;

/// A column that says how good a result is.
struct QualityChange {
  std::string method, column;
  std::size_t rows = 0, better = 0, worse = 0;  ///< of all; the others are equal
};

struct WorseVerdict {
  std::string row, before, after;  ///< `ok`, or what the row has instead
};

struct RunComparison {
  std::string base, head, not_comparable;  ///< why not; empty: they are
  std::size_t rows = 0;                    ///< that both have
  std::vector<TimeRatio> times;            ///< the slowest first
  std::vector<QualityChange> quality;      ///< those that changed
  std::vector<WorseVerdict> worse;
  bool is_slower() const;
  /// There are times, and of none enough cases.
  bool has_too_few_cases() const;
};

/// \param times  a method is slower where the whole interval lies above this ratio
/// Throws InputError: no records.csv or context.json there, or one that can't be read.
RunComparison compare_runs(const std::filesystem::path& base, const std::filesystem::path& head, double times = 1.01);

std::string as_text(const RunComparison& comparison);
std::string as_markdown(const RunComparison& comparison);
std::string as_json(const RunComparison& comparison);

/// Ranks, from 0, between which the median of n values lies with at least 95 % (Conover, Practical Nonparametric
/// Statistics, 1999, 3.2). For n < 6 the whole range.
std::pair<std::size_t, std::size_t> median_ranks(std::size_t n);

}  // namespace cutbench
