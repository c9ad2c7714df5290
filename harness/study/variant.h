// What an experiment runs: methods with the values of their parameters, and the options of the command line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/cut/method_row.h"
#include "harness/records/shard_of.h"
#include "harness/study/experiment.h"

namespace cutbench {

struct RunOptions {
  std::string out = "results";
  std::string command;        ///< recorded
  int shard = 1, shards = 1;  ///< of the run, this one is the `shard`th of so many
  bool quiet = false;         ///< no progress, no table
  int workers = 0;            ///< processes, where no times are recorded; 0: one per core

  /// \param item  numbered from 0 through the whole run, whatever the shard
  bool is_ours(std::size_t item) const { return shard_of(item, to_size(shards)) + 1 == to_size(shard); }
  /// The i < n for which item `first` + i is.
  std::vector<std::size_t> ours(std::size_t first, std::size_t n) const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < n; ++i)
      if (is_ours(first + i)) numbers.push_back(i);
    return numbers;
  }
};

/// The last line of a run's identity (RecordFile).
inline std::string shard_line(const RunOptions& options) {
  return "\n" + std::to_string(options.shard) + "/" + std::to_string(options.shards);
}

/// A method with a value of its parameter, as it appears in records and figures.
struct Variant {
  std::shared_ptr<const MethodRow> row;
  double parameter;
  std::string parameter_text() const;  ///< "rounds=1", or empty
};
/// The experiment's methods and programs. Throws InputError for unknown methods, values of a parameter out of range,
/// and anything named twice.
std::vector<Variant> variants_of(const Experiment& experiment, const std::vector<MethodRow>& methods);

}  // namespace cutbench
