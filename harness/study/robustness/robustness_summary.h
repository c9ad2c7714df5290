// The summary that a robustness run prints: numbers of cuts by outcome, for each method, sheet and family.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/study/robustness/robustness_case.h"

namespace cutbench {

class RobustnessSummary {
 public:
  struct Row {
    std::string family, sheet, method;  ///< with resolution, with parameter
    bool ours = true;
    Counts count{};
  };
  Row& add() { return rows_.emplace_back(); }
  bool all_ok() const;  ///< no fault of ours
  /// To standard output. `stem`, `seed`: of the experiment.
  void print(const std::string& stem, std::uint64_t seed) const;

 private:
  std::vector<Row> rows_;
};

}  // namespace cutbench
