// `cutbench score`: judges a cut that any program made, from files alone.
#pragma once

#include <string>

#include "harness/cut/cut.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

struct ScoreArguments {
  std::string mesh, path, result, report, svg;
  int digits = 0;  ///< that the result was written with; 0: all, strictly
  bool keeps_vertices = false, deletes = false, json = false;
  MeshReading reading;  ///< of the sheet; a result is read by RestFrom::automatic where the sheet's `vt` are not taken
};

/// Prints what the oracle and the audit say, as text or as JSON; writes the JSON where `report` is not empty, and a
/// drawing of the place where something is wrong, or of the whole sheet, where `svg` is not. False where the result is
/// wrong. Throws InputError for files that can't be read.
bool score(const ScoreArguments& arguments, const CutOptions& options);

}  // namespace cutbench
