// The oracle's judgement in the words of the harness, which has verdicts beside the oracle's.
#pragma once

#include <string>
#include <vector>

#include "harness/base/verdict.h"
#include "harness/oracle/oracle.h"

namespace cutbench {

/// As oracle::Judgement, but for the verdict.
struct Judgement {
  Judgement() = default;
  Judgement(const oracle::Judgement& given);  // NOLINT: every judgement of the oracle is one

  bool ok = true;
  Verdict verdict = Verdict::ok;
  std::vector<std::string> problems;
  int pieces = 0, expected_pieces = 0, least_pieces = 0, most_pieces = 0;
  double incision_error = 0, area_change = 0;
};

}  // namespace cutbench
