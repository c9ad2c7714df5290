// SPDX-License-Identifier: MIT
// How a moving sheet moves right before a cut. The sheet itself keeps the places that it was made with.
#pragma once

#include <span>

namespace cutbench {

struct Motion {
  /// m and m/s: `dimension` numbers for each deformed vertex, in the order of their slots; more behind them are ignored
  std::span<const double> x, v;
  int dimension = 3;     ///< 2 or 3
  double poisson = 0.3;  ///< of the sheet, plane stress
};

}  // namespace cutbench
