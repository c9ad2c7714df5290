// Paths that miss the sheet: most often a slip of units, which a cut with nothing to do would hide.
#pragma once

#include <string>

#include "experiments/program/options.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// The curve, as it is traced, meets a triangle of the sheet, if only in a point.
bool meets(const Sheet& sheet, const Curve& curve);

struct Misses {
  bool allowed = false;  ///< --allow-miss
  void add_to(Options& command);
  /// Throws InputError with both bounding boxes where the curve misses the sheet, and that is not allowed.
  /// \param name  of the curve
  void check(const Sheet& sheet, const Curve& curve, const std::string& name) const;
};

}  // namespace cutbench
