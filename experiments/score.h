// `cutbench score`: judges a cut that any program made, from files alone.
#pragma once

#include <string>

#include "harness/cut/cut.h"

namespace cutbench {

struct ScoreArguments {
  std::string mesh, path, result, report;
  bool keeps_vertices = false;
};

/// Prints what the oracle and the audit say; writes it as JSON where `report` is not empty. False where the result is
/// wrong. Throws InputError for files that can't be read.
bool score(const ScoreArguments& arguments, const CutOptions& options);

}  // namespace cutbench
