// Triangles that a moving sheet has turned over: what no energy of a single triangle shows in space.
#pragma once

#include "harness/fem/elements/element_table.h"

namespace cutbench {

struct TurnedOver {
  std::size_t triangles = 0;
  double area = 0;  ///< their share of the rest area
};

/// In the plane: the triangles whose corners are not counter-clockwise at x (exactly). In space, where a triangle has
/// no upper side of its own: those whose area vector points against the sum of those of the triangles that share an
/// edge with them, incisions aside. At a crease, where a sheet is folded, none does. Looks at everything.
/// A member of a compound is where the compound's linear part has it.
/// \param elements  of the sheet
/// \param x  `dimension` (2 or 3) coordinates for each deformed vertex, m
TurnedOver turned_over(const Sheet& sheet, const ElementTable& elements, const Field& x, int dimension);

}  // namespace cutbench
