// The summary that a campaign prints: numbers of cuts by outcome, for each method, sheet and family.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/study/robustness/campaign_case.h"

namespace cutbench {

class CampaignSummary {
 public:
  struct Row {
    std::string family, sheet, method;  ///< with resolution, with knob
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
