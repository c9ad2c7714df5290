// The checks that every mesh passes before it becomes a sheet.
#pragma once

#include <string>

#include "harness/mesh/mesh_data.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench {

/// Makes `mesh` fit for a sheet, or says why it can't be. `name` (the file's) begins every note and error.
/// \pre `rest` and `deformed` have one entry per vertex, or `rest` is empty: then it is taken from `deformed`, which
/// must lie in a plane z, y or x = constant within flatness_tolerance, as the other two axes: (x, y), (x, z) or (y, z).
/// Seen from the axis y, (x, z) turns the other way, so there all triangles are turned round, without a note.
/// \param of_vt  `rest` are the `vt` of a file: said where they are wrong
///
/// Repaired, each with a note: clockwise triangles are reversed (all of them, or the inconsistent ones), never an axis;
/// unused vertices are dropped; a vertex where several fans of triangles meet is split into one per fan.
/// \post every triangle is strictly counter-clockwise in rest space (exact predicate); every edge, also between
/// bit-equal rest positions, has at most one triangle on each side; the triangles round every vertex are one fan. What
/// passed once passes again unchanged.
/// \throw InputError for no triangles, an index out of range or repeated in a triangle, a coordinate that is not finite
/// or beyond 1e60, a mean triangle side (rest) below 1e-60 or below 1e6 ulp of the largest rest coordinate, a curved
/// mesh without rest positions, a triangle of zero rest area, two triangles with the same corners, more than two
/// triangles on an edge or two on the same side of it (folded, overlapping or not orientable in rest space), or parts
/// that overlap elsewhere (overlaps.h). `mesh` is then half-way: discard it.
///
/// Vertices are never merged: two borders at bit-equal rest positions are an incision. A note says so where that leaves
/// no two triangles of the mesh together, as in a file that gives each triangle its own vertices.
void check_and_repair(MeshData& mesh, const std::string& name, bool of_vt = false);
/// Its part that takes `rest` from the plane the mesh lies in, with a note where that is not z = constant, exactly.
/// Corners may be out of range and coordinates not finite.
void take_rest_from_plane(MeshData& mesh, const std::string& name);
/// Is its rest shape the mesh itself: RestFrom::space, or RestFrom::automatic where it is not flat?
bool lies_in_space(const MeshData& mesh, RestFrom from);
/// Gives a mesh without rest positions those of its plane, or unrolls it (unroll.h) where it lies in space.
/// \throw InputError, beginning with `name`
void take_rest(MeshData& mesh, const std::string& name, RestFrom from);

}  // namespace cutbench
