// Phantom nodes: the sheet is not re-meshed, its triangles are doubled where the path crosses them.
//
// How it works: the incision, and the triangles that integrals are taken over, are those of conventional_split; but the
// field on them is linear in each part into which the cuts divide a triangle of the sheet as it was before the first
// one (a parent). A part has a copy of its parent's three corners as its unknowns: where a corner of the parent belongs
// to the part it is that vertex of the sheet, else a phantom. Parts on either side of an edge of the sheet that are
// joined along it, be it in a piece, share the copies of its two ends. All vertices that cuts made are tied to the
// corners of their part by their barycentric coordinates (Ties, harness/mesh/ties.h), so that each copy counts with the
// material that is there, whatever the number of cuts, junctions and loops: sums over the triangles of a part are exact
// integrals over it.
//  - Tip rule: a parent that is not divided all through, because the path ends inside it, has one part and a continuous
//    field. So for the unknowns the incision ends at the edge where the last parent that it crosses completely ends;
//    the lips are drawn up to the tip, and lie on one another from there on. What does not cross a parent opens
//    nothing.
//  - Two copies of a vertex of the sheet that belong to the same part are one unknown: there the path ends, too.
//  - What is held (a pin, a border displacement) is so at the sheet's own vertices and at crossings of the border.
//
// A part with next to no material makes unknowns with next to no stiffness and mass. Two variants, for sheets at rest,
// bound what comes of it:
//  - `ghost`: a penalty on the jump of the normal derivative across the edges at which the parts of a divided parent
//    are joined to its neighbours, `ghost` times edge length squared in K, to the fourth power in M.
//  - a lumped mass, a third of a part's to each corner of its parent: then no part has a larger eigenvalue than that
//    (Menouillard, Rethore, Combescure and Bung, IJNME 68 (2006)).
//
// Source: Hansbo and Hansbo, CMAME 193 (2004); Molino, Bao and Fedkiw, A virtual node algorithm (2004); Song, Areias
// and Belytschko, IJNME 67 (2006); Richardson, Hegemann, Sifakis, Hellrung and Teran, IJNME 88 (2011) for parts and
// junctions; Burman and Hansbo, Applied Numerical Mathematics 62 (2012) for the ghost penalty. Promises: the exact
// path, area, conforming, no vertex moved; an affine displacement is reproduced exactly. Fails: the opening is too
// short by up to a triangle at each tip, and along a bend inside a triangle stress is constant. Without a variant, thin
// parts are no less ill-conditioned than slivers; no penalty reaches a piece smaller than a triangle. The system is
// made anew after each cut, not updated.
#pragma once

#include "harness/cut/cutting_method.h"

namespace cutbench {

class PhantomNode : public CuttingMethod {
 public:
  struct Options {
    double ghost = 0;  ///< dimensionless; 0: no penalty
    bool lumped_mass = false;
  };
  explicit PhantomNode(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  Tying tying() const override {
    return options_.ghost > 0 || options_.lumped_mass ? Tying::phantoms_at_rest : Tying::phantoms;
  }
  Ties ties(const Sheet& before, const Sheet& cut) const override;

 private:
  Options options_;
};

}  // namespace cutbench
