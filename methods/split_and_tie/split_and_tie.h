// Conventional split whose slivers are tied: the triangles stay as bad as they are, the unknowns do not.
//
// How it works: the cut is that of conventional_split, incision, triangles and all. Vertices that it made are then
// taken out of the unknowns where they would be stiff, and go where the linear field of a good triangle on their own
// side of the cut has them. Which ones, and where: methods/tools/tie_slivers.h, with rules for tips, junctions and the
// border.
//
// Source: aggregated finite elements (Badia, Verdugo and Martin, The aggregated unfitted finite element method for
// elliptic problems, CMAME 336, 2018); there the cut cells are integrated and not split. Promises: the exact path,
// area, conforming, no vertex moved; an affine displacement is reproduced exactly. Fails: pieces of slivers only; an
// explicit integrator, since the mass is no longer lumped; and shapes stay bad, for whatever else looks at the
// triangles. Vertices near a cut jump to the field of their triangle at the instant of the cut. The system is made anew
// after each cut, not updated.
#pragma once

#include "harness/cut/cutting_method.h"

namespace cutbench {

class SplitAndTie : public CuttingMethod {
 public:
  struct Options {
    double thinness = 0.1;  ///< lengths below it, times the longest edge nearby, are short; 0: nothing is tied
  };
  explicit SplitAndTie(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  Tying tying() const override { return options_.thinness > 0 ? Tying::vertices : Tying::nothing; }
  Ties ties(const Sheet& before, const Sheet& cut) const override;

 private:
  Options options_;
};

}  // namespace cutbench
