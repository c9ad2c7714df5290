// What a user takes home of a cut beside its triangles: JSON, and columns of a VTU. All numbers are counted from 0.
//
// JSON, one key a line:
//   "vertices"     per vertex of the result [[old, weight], ...]: vertices of the sheet's file, and weights that add up
//                  to 1. One where it is an old vertex, two on an old edge, three inside an old triangle
//                  (mesh/parents.h)
//   "triangles"    per triangle of the result, the old one that holds its centroid
//   "incision"     per edge that a cut opened, cut by cut along the path {"cut": its number in the path file,
//                  "left": [triangle, from, to], "right": [triangle, from, to]}: the edge on each lip, both along the
//                  path; null where a method took the triangles of that side out
//   "polygons"     [triangle, ...] of each element that is several triangles of the result
//   "copies"       per unknown that is no vertex, the old vertex that it is a copy of; number i counts as a vertex
//                  of number i + how many vertices the result has
//   "constraints"  [vertex, [[master, weight], ...]] of each vertex that is no unknown, but goes along with others
//   "texture"      per triangle of the result [[u, v], [u, v], [u, v]] at its corners, where the file had a texture
//                  (mesh/texture.h)
//
// A VTU has for each vertex parents and parent_weights (three each; -1 and 0 where there are fewer), and where there
// are constraints masters and master_weights in the same way, with the copies as field data. For each triangle it has
// parent and lips: for its edge from corner k to the next n on the left lip of cut n - 1, -n on its right one, else 0;
// and where there are polygons the number of its polygon, else -1.
#pragma once

#include <string>
#include <vector>

#include "harness/mesh/constraints.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/parents.h"
#include "harness/mesh/texture.h"
#include "harness/path/incisions.h"

namespace cutbench {

/// Of a sheet that was read from a file, and cut.
struct CutDetails {
  const MeshData& read;  ///< from the file
  const Sheet& cut;
  Parents parents;
  std::vector<IncisionEdge> incision;
  Constraints constraints;
  Texture texture = {};  ///< per triangle of cut.to_mesh_data(), its corners in the order of the file that is written
};

std::string details_json(const CutDetails& details);
std::vector<MeshColumn> details_columns(const CutDetails& details);

}  // namespace cutbench
