// The engine of all studies: what belongs to a run whatever it measures. A kind of study (cuts, accuracy, robustness,
// stability) derives from it and says its columns, its cases, how to run them, and its summary.
#pragma once

#include <string>
#include <vector>

#include "harness/records/record.h"
#include "harness/study/experiment.h"
#include "harness/study/progress.h"
#include "harness/study/right_results.h"
#include "harness/study/variant.h"

namespace cutbench {

/// Two runs with equal texts may share rows: the program and its machine, the experiment as it was asked for
/// (Experiment::asked), its seed, and its methods with their parameters and the files of its programs.
/// \param with_times  rows hold times, which depend on the processor
std::string identity_of(const Experiment& experiment, const Context& context, bool with_times);

class Study {
 public:
  virtual ~Study() = default;
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// Runs the cases that no earlier run has recorded, writes <out>/<stem>/records.csv and context.json, and prints the
  /// summary. False where a result is not as it should be. Throws OutputError where there is no room.
  bool run();

 protected:
  /// What its rows look like.
  struct Rows {
    const std::vector<std::string>& columns;
    std::size_t keys = key_columns;  ///< so many of the first columns say what was measured
    bool with_times = true;
  };
  /// Opens the file of the rows; a killed run of the same identity and shard goes on there. All arguments must outlive
  /// the study. Throws InputError where the folder can't be written.
  Study(const Experiment& experiment, const Context& context, const RunOptions& options, const Rows& rows);

  /// For the progress; called once, right before run_cases().
  virtual std::size_t case_count() = 0;
  virtual void run_cases(Progress& progress) = 0;
  /// Called at the end for every row, those of before a resumption too.
  virtual void add_row(const Record& row, RightResults& results) { results.add(row); }
  /// To standard output; called after add_row(), and not at all where the options say quiet.
  virtual void print_summary() const = 0;
  virtual bool all_ok() const = 0;

  const Experiment& experiment_;
  const RunOptions& options_;
  RecordFile file_;

 private:
  const Context& context_;
  const std::vector<std::string>& columns_;
};

}  // namespace cutbench
