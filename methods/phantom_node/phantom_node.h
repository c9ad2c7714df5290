// Phantom nodes: for the unknowns the sheet is not divided; its triangles are doubled where the path crosses them.
//
// How it works: the incision, and the triangles that integrals are taken over, are those of conventional_split. The
// field on them is linear in each part (but one with a tip in it) into which the cuts divide a parent, which is a
// triangle of the sheet before the first cut. A part has its own copy of its parent's three corners as its unknowns: a
// corner that belongs to the part is that vertex of the sheet, any other is a phantom node. Parts on the two sides of
// an edge of the sheet that are joined along it, or along a piece of it, share the copies of its two ends. All vertices
// that cuts made are constrained to the corners of their part by their barycentric coordinates (Constraints,
// harness/mesh/constraints.h). So sums over the triangles of a part are exact integrals over it, for any number of
// cuts, junctions and loops.
//  - Tip rule: a part that lies on both sides of an incision, because that ends inside, is slit. It has one copy of
//    each corner, but its field is linear in each of its triangles only: where the incision enters, the two lips go
//    along with the copies beyond the edge, and all other vertices, the tip among them, with the part's own. So the
//    jump goes linearly to zero from the edge to the tip, and ahead of the tip the field is continuous.
//    Where that cannot be, the incision ends for the unknowns where it enters the part (the lips reach up to the tip,
//    but coincide): where it enters at a corner, or from another slit part, or where the lips would be too stiff
//    because the tip is close to the edge at which it enters. At a bend inside the part it ends at the bend.
//  - Copies of a vertex of the sheet that belong to the same part are one unknown.
//  - Supports (pins, border displacements) act on the sheet's own vertices and on crossings of the border.
//
// A part with almost no material makes unknowns with almost no stiffness and mass. What bounds the consequences:
//  - The mass is lumped, a third of a part's to each corner of its parent: then no part that is not slit has a larger
//    eigenvalue of the membrane than its parent, for stiffness and mass have the same factor. (Menouillard, Rethore,
//    Combescure and Bung, IJNME 68 (2006; summary read), show a step of the same order for another lumping.) A lip in a
//    slit part stiffens copies whose mass may come from a thin part alone, the one beyond the edge. So the limit that
//    keeps a tip closed is lower here, by the share that this part has of its parent's area.
//  - `phantom_node:consistent_mass` has the mass of the linear fields instead, exact, and no such bound. Its `ghost` is
//    a penalty, for sheets at rest, on the jump of the normal derivative across the edges at which the parts of a
//    divided parent are joined to its neighbours: `ghost` times edge length squared in K, to the fourth power in M.
//
// In motion: phantom nodes have positions and velocities. A new one begins with those that the element had at that
// corner which its part was cut from: an element of before, or the sheet's triangle. So what is linear in the element
// goes on as it was.
//
// Bending: that of whole copies, times a part's share of its parent's area (harness/fem/elements/copied_bending.h); a
// part that is slit bends as a whole. This is this program's reading: no source here has bending. It has no bound for
// thin parts, since whole neighbours bend against their corners, too.
//
// Source: Hansbo and Hansbo, CMAME 193 (2004; not read); Song, Areias and Belytschko, IJNME 67 (2006; abstract read),
// of which only the doubling is here: no growing cracks, no shear bands, no quadrilaterals with one point; Rabczuk, Zi,
// Gerstenberger and Wall, IJNME 75 (2008), for a jump that vanishes at a tip inside a triangle (cited from memory;
// theirs is another element); Richardson, Hegemann, Sifakis, Hellrung and Teran, IJNME 88 (2011; not read), for parts
// and junctions; Burman and Hansbo, Applied Numerical Mathematics 62 (2012; not read), for the ghost penalty.
// Promises: the exact path, area, conforming, no vertex moved; an affine displacement is reproduced exactly.
// Where it fails: the opening is too short where the tip rule cannot hold, and at a bend of the path inside a triangle
// the stress is constant. With a consistent mass, thin parts are as ill-conditioned as slivers; no penalty reaches a
// piece smaller than a triangle. Copies are found from the last cut (methods/tools/last_cut.h),
// but the rows of the system near all cuts are written again after each.
#pragma once

#include "harness/cut/constraint_source.h"
#include "methods/tools/copied_elements.h"

namespace cutbench {

class PhantomNode : public CuttingMethod, private ConstraintSource {
 public:
  explicit PhantomNode(const CopyOptions& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  const ConstraintSource* constraint_source() const override { return this; }

 private:
  ConstraintKind constraint_kind() const override {
    if (options_.ghost > 0) return ConstraintKind::phantoms_at_rest;
    return options_.lumped_mass ? ConstraintKind::lumped_phantoms : ConstraintKind::phantoms;
  }
  Constraints constraints(const Sheet& before, const Sheet& cut) const override;
  Constraints next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                               const PolygonsLeft& left) const override;

  CopyOptions options_;
};

}  // namespace cutbench
