// Virtual nodes: an element that a cut separates is copied whole, once for each piece of its material.
//
// How it works: the incision, and the triangles that show the surface, are those of conventional_split. The elements
// are the triangles of the sheet before its first cut, and whole copies of them with virtual nodes where a piece has no
// corner (methods/tools/copied_elements.h); the surface goes along with the copy that its piece is in.
//  - Material: a copy has the stiffness, the bending and the mass of a whole triangle times its piece's share of the
//    area, the mass a third at each corner. So no copy has a larger eigenvalue of the membrane than the whole one, and
//    the bound that elements give for an explicit step stays.
//  - Copies share the nodes of an edge where their pieces are joined along it. That is asked of the pieces and not of
//    where the cut meets the edge, so cuts through vertices and along edges are as all others.
//  - Tip inside an element: that does not separate it, so it is not copied, and its field is linear across the slit.
//    The incision ends for the unknowns where it enters its last triangle; the lips there coincide. This is the one
//    thing that differs from phantom_node, which opens such a triangle where it can.
//  - In motion and bending: as phantom_node.
//
// Source: Molino, Bao and Fedkiw, A virtual node algorithm for changing mesh topology during simulation (2004; its
// abstract alone was read), for copies with the material of a piece; Sifakis, Der and Fedkiw, Arbitrary cutting of
// deformable tetrahedralized objects (2007; not read), for any number of pieces in one element; Wang, Jiang, Schroeder
// and Teran, An adaptive virtual node algorithm with robust mesh cutting (2014; its abstract alone was read), for cuts
// through vertices and edges. The first shows thin shells, too; how they bend was not read. The other two are about
// tetrahedra. The bending and the rule for tips are this program's reading.
// Promises: the exact path, area, conforming, no vertex moved; an affine displacement is reproduced exactly.
// Where it fails: a cut is too short by up to a triangle at each tip, and one within a triangle opens nothing. With
// bending thin pieces have no bound, since whole neighbours bend against their corners, too.
#pragma once

#include "harness/cut/constraint_source.h"

namespace cutbench {

class VirtualNode : public CuttingMethod, private ConstraintSource {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  const ConstraintSource* constraint_source() const override { return this; }

 private:
  ConstraintKind constraint_kind() const override { return ConstraintKind::lumped_phantoms; }
  Constraints constraints(const Sheet& before, const Sheet& cut) const override;
  Constraints next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                               const PolygonsLeft& left) const override;
};

}  // namespace cutbench
