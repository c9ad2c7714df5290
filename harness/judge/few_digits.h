// Results written with few digits: which vertices are the sheet's, and how much the others may be off.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench {

/// A result read with a given number of significant digits: those of the sheet's largest coordinate, so that numbers
/// with a fixed number of decimals, and single precision as 7 or 8 digits, are meant as well.
struct FewDigits {
  int digits = 0;            ///< 0: strict, all digits are needed
  double unit = 0;           ///< of the last digit: a coordinate may be off by as much, cut off or rounded; rest units
  double rounding = 0;       ///< the distance that this makes
  std::size_t vertices = 0;  ///< of the result
  std::size_t of_the_sheet = 0;  ///< put back: those within a unit of a vertex of the sheet in each coordinate
  double farthest = 0;           ///< coordinate that was put back

  /// What was lost and what is allowed for it, one line.
  std::string text() const;
};

/// Puts the vertices of `after` that are vertices of `before`, but for the digits, where these are, bit for bit. That
/// is sound where no two places of the sheet are so near that digits could mix them up.
/// \param digits  1 to 17
/// \throw InputError: two places of `before` are within two units of each other in both coordinates
FewDigits put_back(oracle::Mesh& after, const oracle::Mesh& before, int digits);

/// The most digits that allow for coordinates that are off by this much.
int digits_that_allow(double off, const oracle::Mesh& before);

}  // namespace cutbench
