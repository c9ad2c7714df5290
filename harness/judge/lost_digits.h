// Numbers that a file holds with fewer digits than a double has.
#pragma once

#include <string>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench {

/// "in single precision" or "with 6 decimals" where all coordinates of the points are such numbers, and at least four
/// of them use most of these digits: computed numbers are so by chance about once in 1e30. Else empty.
std::string lost_digits(const std::vector<oracle::Point>& points);

}  // namespace cutbench
