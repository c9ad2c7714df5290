// Numbers that a file holds with fewer digits than a double has.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench {

/// "in single precision" or "with 6 decimals" where all coordinates of the points are such numbers, and at least four
/// different ones of them use most of these digits: computed numbers are so by chance about once in 1e30. Else empty.
/// \param known  numbers that nobody computed, which say nothing
std::string lost_digits(const std::vector<oracle::Point>& points, const std::set<double>& known = {});

}  // namespace cutbench
