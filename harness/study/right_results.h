// Which methods of a run have no right result at all: most often a command with a mistake in it, which the medians of a
// summary would leave out.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "harness/records/record.h"
#include "harness/study/experiment.h"

namespace cutbench {

class RightResults {
 public:
  /// \param row  with `method`, `status`, `verdict` and `reason`. A cut that had nothing to do tells nothing.
  void add(const Record& row);
  /// \param why  of the last that is not right; empty: there is none
  void add(const std::string& method, std::int64_t right, std::int64_t others, const std::string& why);
  /// A line on standard error for each method that has results, and no right one. False where one of them is a program
  /// of the experiment's.
  bool report(const Experiment& experiment, bool quiet) const;

 private:
  struct Counts {
    std::int64_t right = 0, others = 0;
    std::string why;
  };
  std::map<std::string, Counts> methods_;
};

}  // namespace cutbench
