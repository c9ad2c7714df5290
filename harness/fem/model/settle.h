// Where the vertices that a cut made or moved belong in a bent sheet.
//
// A cut does not move the sheet. But where the sheet is between its vertices only the energy knows: transfer() puts new
// vertices on the flat triangles of before, and there bending, which takes the sheet for smooth, finds a sharp fold
// beside each of them, the sharper the finer the new triangles are. That energy is of the interpolation, not of the
// sheet.
#pragma once

#include "harness/fem/model/model.h"

namespace cutbench {

/// Moves the vertices that the sheet's last cut made or moved in rest space to where the energy of membrane and bending
/// is least while all others stay; it never rises. Both lips of the new incision move alike, so that they stay closed:
/// to open them is the next steps' work. Held vertices stay. Velocities are not touched. Needs bending, and a sheet in
/// space that is flat at rest; does nothing otherwise. Cost: by the number of these vertices.
/// \param x  m: after transfer()
/// \pre model.update() and update_bending() are done, and constrain() for polygons, but for no other constraints
template <int D>
void settle_new_vertices(const Model<D>& model, const Sheet& sheet, Field& x);

}  // namespace cutbench
