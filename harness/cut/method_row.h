// SPDX-License-Identifier: MIT
// A row of the table of methods: how a method is named, what may be set in it, what it guarantees, and how it is made.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "harness/cut/cutting_method.h"

namespace cutbench {

/// The values that a parameter may take: finite ones from `least` to `most`, both included.
struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool whole = false;    ///< whole numbers alone
  bool or_zero = false;  ///< 0 as well, below `least`: it leaves a step of the method out

  bool has(double value) const;
  /// Such as "a whole number from 0 to 6" or "0, or a number of at least 2".
  std::string text() const;
};

/// The one number of a method that may be swept.
struct Parameter {
  std::string name;  ///< empty: the method has none
  double value = 0;  ///< default
  std::string meaning;
  Range range = {};
};

/// The largest incision error that a method promises: the sum of the terms, and at most the longest edge. The tolerance
/// of flattening and twice the snap distance come on top, for every method.
struct IncisionBound {
  double longest_edges = 0;     ///< times the longest rest edge of the sheet before the cut
  double chord_tolerances = 1;  ///< times the chord tolerance that the cut asks for
};

/// What a method guarantees for every cut it does not refuse. The tests hold it to that.
struct Promises {
  bool exact_incision = false;        ///< opens the traced path itself: no shortcut, no shift
  bool keeps_area = false;            ///< the rest area is unchanged
  bool conforming = false;            ///< the result is a conforming triangulation
  bool keeps_vertices = false;        ///< no vertex of the sheet moves in rest space
  IncisionBound incision_bound = {};  ///< the default is what the trace itself keeps, and so every exact incision
};

struct MethodRow {
  std::string name, summary;
  Parameter parameter;
  Promises promises;
  std::function<std::unique_ptr<CuttingMethod>(double parameter)> factory;

  /// A new one. Throws InputError: a value out of the parameter's range. A method without a parameter takes any value.
  std::unique_ptr<CuttingMethod> make(double value) const;
};

}  // namespace cutbench
