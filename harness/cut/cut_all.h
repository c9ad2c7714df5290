// Several cuts made in a sheet, one after the other.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "harness/cut/cut.h"

namespace cutbench {

/// Result of several cuts. It ends with the first failed or refused cut; the cuts before it stay.
struct CutRun {
  Status status = Status::ok;
  Verdict verdict = Verdict::ok;
  std::string reason;
  std::size_t crossed_triangles = 0;
  int recovered_segments = 0;
  bool carefully = false;  ///< at least one of them (CutOutcome::carefully)
  PhaseTimes time_us;
  double cpu_us = 0;  ///< process CPU time of all cuts
};
/// \param after_cut  called with the number of the cut, from 0, after each that changed the sheet; may be empty
CutRun cut_all(Sheet& sheet, Locator& locator, Cutter& cutter, std::span<const Curve> cuts, CuttingMethod& method,
               const CutOptions& options, const std::function<void(std::size_t)>& after_cut = {});

}  // namespace cutbench
