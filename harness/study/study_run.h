// The engine of all studies: what belongs to a run whatever it measures. A kind of study (cuts, accuracy, robustness,
// stability) derives from it and says its columns, its cases, how to run one, and its summary.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/processes/isolated.h"
#include "harness/records/record.h"
#include "harness/study/experiment.h"
#include "harness/study/progress.h"
#include "harness/study/right_results.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Two runs with equal texts may share rows: the program and its machine (its processor, too, where rows hold times),
/// the experiment as it was asked for (Experiment::asked), its seed, and its methods with their parameters and the
/// files of its programs.
std::string identity_of(const Experiment& experiment, const Context& context);

class StudyRun {
 public:
  virtual ~StudyRun() = default;
  StudyRun(const StudyRun&) = delete;
  StudyRun& operator=(const StudyRun&) = delete;

  /// Runs the cases that no earlier run has recorded, writes <out>/<stem>/records.csv and context.json, and prints the
  /// summary. False where a result is not as it should be. Throws OutputError where there is no room.
  bool run();

 protected:
  /// Opens the file of the rows; a killed run of the same identity and shard goes on there. All arguments must outlive
  /// the run. Throws InputError where the folder can't be written.
  /// \param keys  so many of the first columns say what was measured
  StudyRun(const Experiment& experiment, const Context& context, const RunOptions& options,
           const std::vector<std::string>& columns, std::size_t keys = key_columns);

  /// For the progress; called once, right before run_cases().
  virtual std::size_t case_count() = 0;
  virtual void run_cases(Progress& progress) = 0;
  /// Called at the end for every row, those of before a resumption too.
  virtual void add_row(const Record& row, RightResults& results) { results.add(row); }
  /// To standard output; called after add_row(), and not at all where the options say quiet.
  virtual void print_summary() const = 0;
  virtual bool all_ok() const = 0;

  /// Takes the next `n` items of the whole run: the i < n that are this shard's. Shards agree only where each takes all
  /// items in the same order.
  std::vector<std::size_t> next_ours(std::size_t n);
  bool next_is_ours() { return options_.is_ours(items_++); }

  /// With what the rows of every study say.
  Record start_row(const std::string& sheet, std::int64_t resolution, const std::string& method,
                   const std::string& parameter) const;

  /// Calls work(i, result) for each i < n in processes of their own (run_isolated()), where it fills a shared result,
  /// and then take(i, result, fate) here, in order. \param begun  as run_isolated()'s progress
  template <class Result, class Work, class Take>
  void run_apart(std::size_t n, double time_limit_s, const Work& work, const Take& take,
                 const std::function<void(std::size_t)>& begun = {}) const {
    const SharedArray<Result> results(n);
    const auto fates = run_isolated(
        n, {options_.workers, time_limit_s}, [&](std::size_t i) { work(i, results[i]); }, begun);
    for (std::size_t i = 0; i < n; ++i) take(i, results[i], fates[i]);
  }
  /// The verdict of a case whose process ended before it was done.
  static void set_fate(Record& row, Fate fate);

  const Experiment& experiment_;
  const RunOptions& options_;
  RecordFile file_;

 private:
  const Context& context_;
  const std::vector<std::string>& columns_;
  std::size_t items_ = 0;  // taken so far, of all shards
};

}  // namespace cutbench
