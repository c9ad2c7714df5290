// The edges of a sheet's own border: not the lips of its incisions.
#pragma once

#include <array>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

template <class Visit>
void for_each_border_edge(const Sheet& sheet, Visit visit) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const TriangleIndex slot(t); sheet.triangle(slot).alive() && sheet.on_border(half_edge(slot, k)))
        visit(half_edge(slot, k));
}

/// The deformed vertices of the ends of a half-edge.
inline std::array<DeformedIndex, 2> deformed_ends(const Sheet& sheet, HalfEdge h) {
  const auto& deformed = sheet.triangle(triangle_of(h)).deformed;
  return {deformed[to_size(corner_of(h))], deformed[to_size(next_corner(corner_of(h)))]};
}

}  // namespace cutbench
