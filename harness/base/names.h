// Names in error messages: which of the known ones may have been meant.
#pragma once

#include <string>
#include <vector>

namespace cutbench {

/// The names by their edit distance (Levenshtein) from `name`, the nearest first; equally near ones in their order.
std::vector<std::string> nearest_first(const std::string& name, std::vector<std::string> known);

/// What to say after an unknown name: `did you mean "x"?` where one is near, with a third of its letters wrong at most;
/// else `otherwise`.
std::string suggestion(const std::string& name, const std::vector<std::string>& known, const std::string& otherwise);

/// "a, b, c"
std::string listed(const std::vector<std::string>& names);

}  // namespace cutbench
