// Opening an incision: every fan of triangles round a vertex, between border, older incisions and the new path, gets a
// vertex of the deformed sheet of its own. Since fans are counted and not sides, tips (one fan), ends at the border
// (two), crossings of incisions (four) and junctions need no special cases.
#pragma once

#include "harness/mesh/sheet.h"

namespace cutbench {

/// Opens the edges marked `path` since begin_cut(): they become incisions. The first fan at a vertex, counter-clockwise
/// from the first separating outgoing edge, keeps the deformed vertex; each other fan that shared it gets a copy at the
/// same place. Cost: the triangles at the path's vertices.
void open_path(Sheet& sheet);

}  // namespace cutbench
