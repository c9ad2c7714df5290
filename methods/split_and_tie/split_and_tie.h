// Conventional split with constrained slivers: the triangles keep their bad shapes, but the unknowns that make them
// stiff are eliminated.
//
// How it works: the cut is that of conventional_split, incision and triangles alike. Vertices of slivers that it made
// are then constrained: each is extrapolated from a well-shaped master triangle on its own side of the cut, by the
// linear field of that triangle. Which vertices, and which masters: methods/tools/constrain_slivers.h, with rules for
// tips, junctions and the border.
//
// Source: aggregated finite elements (Badia, Verdugo and Martin, The aggregated unfitted finite element method for
// elliptic problems, CMAME 336, 2018; not read); there the cut cells are integrated and not split.
// Promises: the exact path, area, conforming, no vertex moved; an affine displacement is reproduced exactly.
// Where it fails: on pieces that consist of slivers only, and with an explicit integrator, since the mass is no longer
// lumped. The triangles stay ill-shaped for every other use. Vertices near a cut jump to the field of their master
// triangle at the instant of the cut. In motion constraints stay where a cut did not come near.
#pragma once

#include "harness/cut/constraint_source.h"

namespace cutbench {

class SplitAndTie : public CuttingMethod, private ConstraintSource {
 public:
  struct Options {
    double thinness = 0.1;  ///< lengths below it, times the longest edge nearby, are short; 0: nothing is constrained
  };
  explicit SplitAndTie(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  const ConstraintSource* constraint_source() const override { return options_.thinness > 0 ? this : nullptr; }

 private:
  ConstraintKind constraint_kind() const override { return ConstraintKind::vertices; }
  Constraints constraints(const Sheet& before, const Sheet& cut) const override;
  Constraints next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                               const PolygonsLeft& left) const override;

  Options options_;
};

}  // namespace cutbench
