// A sheet that becomes what another program made of it, by the sheet's own editing calls. So its log says what changed,
// and undo, the transfer of a moving sheet's state and the update of a model's matrix work as for any other cut.
#pragma once

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Replaces the triangles of `sheet` that `result` does not have, whose corners are matched by bit-equal rest
/// positions. What `result` has opened and the sheet has not is marked `path`, still closed: open_path() opens it. The
/// numbers of vertices and triangles in `result`, and its deformed positions, do not matter: new vertices are placed by
/// the sheet's own map from rest to deformed, each on its side of older incisions.
/// \param deletes  instead of replacing them, takes the triangles out that `result` does not have, as a cut by the
///   method element_deletion does
/// \pre begin_cut(); the oracle accepts `result` as a cut of `sheet` that keeps the area, or as one that deletes.
/// Throws CutRefused for what the sheet can't take over: a vertex that is held, or one of an older incision, is gone;
/// several vertices of the sheet lie at one place; or parts of the result lie too close together to be told apart.
void adopt(Sheet& sheet, const MeshData& result, bool deletes = false);

}  // namespace cutbench
