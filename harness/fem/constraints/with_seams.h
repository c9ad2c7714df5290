// The constraints of a sheet with seams: those of its method, and those that keep it sewn (harness/mesh/seams.h).
#pragma once

#include <cstdint>
#include <span>

#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// All of `own`, with the seams' constraints behind those of its vertices. Where a seam ties a vertex that the method
/// constrains, too, the seam's holds; where a row would have more than three masters, the heaviest ones stay.
/// \param pinned  per deformed slot, not 0: it is a master rather than a tied vertex, so that a pin holds both sides
Constraints with_seams(const Constraints& own, const Sheet& sheet, std::span<const std::uint8_t> pinned);

}  // namespace cutbench
