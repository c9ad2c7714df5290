// Triangles that a moving sheet has turned over: what no energy of a single triangle shows in space.
#pragma once

#include "harness/fem/elements/element_table.h"

namespace cutbench {

struct TurnedOver {
  std::size_t triangles = 0;
  double area = 0;  ///< their share of the rest area
};

/// In the plane: the triangles whose corners are not counter-clockwise at x (exactly). In space a triangle has no upper
/// side of its own, and a fold turns the other side up and leaves all lengths: turned over is a triangle that points
/// against two of the triangles that share an edge with it or more, incisions aside, and along fewer, where it or one
/// of those is longer or shorter than at rest by a quarter. So a crease is none, and neither are two triangles that are
/// folded on each other, whatever their strain. Looks at everything.
/// A member of a compound is where the compound's linear part has it.
/// \param elements  of the sheet
/// \param x  `dimension` (2 or 3) coordinates for each deformed vertex, m
TurnedOver turned_over(const Sheet& sheet, const ElementTable& elements, const Field& x, int dimension);

}  // namespace cutbench
