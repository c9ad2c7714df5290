// SPDX-License-Identifier: MIT
// What the harness has to know of a program of its own that makes the cuts in the place of a class (harness/programs).
#pragma once

#include <string>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/subdivision.h"

namespace cutbench {

struct CutOptions;  // harness/cut/cut.h

class CutProgram {
 public:
  /// Makes the whole cut, in the place of adapt(), embed() and improve(): from the curve as it was asked for, not from
  /// its trace. Marks what has to be opened as they do, and leaves nothing in the trace that runs along edges. Returns
  /// the microseconds that the program took, above 0. Throws CutFailed, or CutRefused.
  virtual double run(Sheet& sheet, Subdivision& trace, const Curve& curve, const CutOptions& options) = 0;

  /// As it was given, for /bin/sh: with {mesh}, {path} and {out}.
  virtual const std::string& command() const = 0;

 protected:
  ~CutProgram() = default;  // it is deleted as the method that it is
};

}  // namespace cutbench
