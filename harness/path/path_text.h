// Cuts as the text of a path file.
#pragma once

#include <string>
#include <vector>

#include "harness/path/curve.h"
#include "harness/path/pick.h"

namespace cutbench {

/// `{"cuts": [{"bezier": [[x,y], ...]}, {"polyline": [[x,y], ...], "closed": true}]}`; `name` begins every error.
/// \throw InputError
std::vector<Curve> read_path_text(const std::string& text, const std::string& name);

/// The same, in which cuts may have "space": "world"; their points are [x, y, z] or {"origin": [x, y, z], "direction":
/// [x, y, z]}.
/// \throw InputError
std::vector<AnyCurve> read_path_text_with_picks(const std::string& text, const std::string& name);

/// What read_path_text() gives back unchanged.
std::string path_text(const std::vector<Curve>& cuts);

}  // namespace cutbench
