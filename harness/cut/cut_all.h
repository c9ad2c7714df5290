// Several cuts made in a sheet, one after the other.
#pragma once

#include <span>
#include <string>

#include "harness/cut/cut.h"

namespace cutbench {

/// Several curves cut one after the other. A failure ends it; what came before stays.
struct CutRun {
  Status status = Status::ok;
  std::string verdict = "ok", reason;
  std::size_t crossed_triangles = 0;
  int recovered_segments = 0;
  bool carefully = false;  ///< one of them, at least: see CutOutcome
  PhaseTimes time_us;
  double cpu_us = 0;  ///< process CPU time of the whole
};
CutRun cut_all(Sheet& sheet, Locator& locator, Cutter& cutter, std::span<const Curve> cuts, CuttingMethod& method,
               const CutOptions& options);

}  // namespace cutbench
