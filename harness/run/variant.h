// What an experiment runs: methods with the values of their knobs, and the options of the command line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/cut/cutting_method.h"
#include "harness/run/experiment.h"

namespace cutbench {

struct RunOptions {
  std::string out = "results";
  std::string command;        ///< recorded
  int shard = 1, shards = 1;  ///< case i is this shard's where i mod shards = shard - 1
  bool quiet = false;         ///< no progress, no table
  int workers = 0;            ///< processes, where no times are recorded; 0: one per core
};

/// The last line of a run's identity (RecordFile).
inline std::string shard_line(const RunOptions& options) {
  return "\n" + std::to_string(options.shard) + "/" + std::to_string(options.shards);
}

/// A method with a value of its knob, as it appears in records and figures.
struct Variant {
  std::shared_ptr<const MethodRow> row;
  double knob;
  std::string knob_text() const;  ///< "rounds=1", or empty
};
/// The experiment's methods and programs. Throws InputError for unknown methods, values of a knob out of range, and anything named twice.
std::vector<Variant> variants_of(const Experiment& experiment, const std::vector<MethodRow>& methods);

}  // namespace cutbench
