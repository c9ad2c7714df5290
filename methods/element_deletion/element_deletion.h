// Element deletion: the triangles that the path crosses are taken out. A baseline.
//
// How it works: nothing is divided; every triangle with a piece of the path in its interior goes, with what it weighed.
// Pieces of path along edges release these edges, whole ones. What is left at a vertex in several fans comes apart
// there.
//
// Source: carving in surgery simulators and tearing in games, where a broken element is no longer drawn; SOFA's carving
// plugin. The same in fracture by finite elements: Song, Wang and Belytschko, A comparative study on finite element
// methods for dynamic fracture, Computational Mechanics 42, 2008 (element deletion).
// Promises: conforming; what stays keeps its shape. Not the exact path, not the area: a band one to two triangles wide
// is gone, more of the sheet the more is cut, and a tip is where its triangle ended; nor that vertices stay: none
// moves, but those of no triangle are gone.
// Fails: the loss does not shrink with the triangles' number but with their size; a second cut within a triangle's
// width of the first does nothing; a cut through all triangles of a sheet is refused, since nothing would be left.
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
