// Which triangles cuts made, found from the vertices that they made: at a cost that does not grow with the sheet.
#pragma once

#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

struct DividedTriangle {
  TriangleIndex part;    ///< of the sheet that was cut
  TriangleIndex parent;  ///< of the sheet before its first cut: it holds the part's centroid
};

/// A triangle that cuts made: one with a vertex that `before` has not. \pre it is alive
bool is_part(const Sheet& before, const Sheet& cut, TriangleIndex t);

/// The triangle of `before` that a part, of a sheet that was only divided, lies in. A part keeps its parent's slot, and
/// slots follow the path: from the last part's parent, `start`, the walk is short.
TriangleIndex parent_of(const Sheet& before, const Sheet& cut, TriangleIndex part, TriangleIndex start);

/// The triangles of `cut` that are new, in the order of their slots: those with a vertex that `before` has not.
/// \param before  the sheet before its first cut
/// \param only_divided  `cut` is a copy of it that was divided, but not changed otherwise. Then it looks at new slots
/// alone,
///                      if `before` has no free ones, else at all vertices.
std::vector<TriangleIndex> new_triangles(const Sheet& before, const Sheet& cut, bool only_divided);

/// Those that the last cut made or changed: the log of `cut` names them.
std::vector<TriangleIndex> last_new_triangles(const Sheet& before, const Sheet& cut);

/// The same as new_triangles(), with the triangles that they are parts of. `cut` was only divided.
std::vector<DividedTriangle> divided_triangles(const Sheet& before, const Sheet& cut);

}  // namespace cutbench
