// Element deletion: the triangles that the path crosses are removed. A baseline.
//
// How it works: nothing is divided. Every triangle with a piece of the path in its interior is removed, with its mass.
// Where the path runs along an edge, the whole edge is opened. Where the remaining triangles at a vertex form several
// fans, these are separated.
//
// Source: carving in surgery simulators and tearing in games, where a broken element is no longer drawn; SOFA's carving
// plugin. The same in fracture by finite elements: Song, Wang and Belytschko, A comparative study on finite element
// methods for dynamic fracture, Computational Mechanics 42, 2008 (element deletion; not read).
// Promises: conforming; the remaining triangles keep their shapes. Not the exact path: the new border is within the
// longest edge of the path, since every removed triangle is crossed. Not the area: a band of one to two triangles'
// width is removed, the more the longer the cut, and a tip lies where its triangle ended. Not that vertices stay: none
// moves, but those left without triangles are removed.
// Where it fails: the lost area depends on the size of the triangles. A second cut within a triangle's width of the
// first does nothing. A cut through all triangles of a sheet is refused, since nothing would be left.
#pragma once

#include "harness/cut/cutting_method.h"

namespace cutbench {

class ElementDeletion : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes&) override;

 private:
  std::vector<TriangleIndex> crossed_;
};

}  // namespace cutbench
