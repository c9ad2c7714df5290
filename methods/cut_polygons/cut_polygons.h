// Cut polygons: thin parts of crossed triangles and their neighbours are one finite element together, a polygon.
//
// How it works: the cut is that of conventional_split, incision and triangles alike. For the physics the thin triangles
// that it made are merged with their neighbours on their own side of the incision (methods/tools/thin_parts.h). Each
// polygon is a virtual element of lowest order (harness/fem/elements/polygon_element.h, compound_sheet.h): one
// deformation gradient, one rotation, a stabilisation, and a mass of area / k at each of its k corners, so the mass
// stays diagonal and the method is one for explicit integrators, too. Vertices that come to lie inside a polygon are no
// unknowns; they go along with its linear map. Triangles that are not thin stay what they are.
//  - A tip inside a triangle: the triangles round it are merged as any others, so that a polygon may reach round the
//    tip, with the incision as a slit. Its gradient is then the mean over both sides, and how the slit gapes inside it
//    is left to the stabilisation.
//  - A second cut dissolves the polygons whose triangles it changes; what it made and what is left of them is merged
//    anew. All others stay, unless one of these joins them. So the polygons depend on the order of the cuts, as the
//    triangles do.
//
// Source: CutVEM (Rangarajan and Sukumar, arXiv 2508.10570, 2025, abstract read), for fields on fixed meshes; Beirao da
// Veiga, Brezzi, Cangiani, Manzini, Marini and Russo, M3AS 23 (2013; not read), for the element. Not CutVEM itself:
// there cells are merged for the eigenvalues of their matrices, and every vertex stays an unknown. The variant
// `cut_polygons:all_unknowns` keeps them: it makes no polygon with a vertex inside.
// Promises: the exact path, area, conforming, no vertex moved; an affine displacement is reproduced exactly.
// The error depends on the stabilisation (`cut_polygons:stabilisation` has it as its parameter): small values make a
// polygon soft in its hourglass modes, large ones as stiff as the triangles that it replaces.
// Where it fails: strips between cuts, and pieces smaller than a triangle, stay as thin as they are. The field in a
// polygon is coarser than that in the triangles that it replaces. The corners' masses keep the mass of a polygon, but
// not its centre. The triangles stay ill-shaped for every other use, and those inside a polygon may turn over in space
// where the polygon does not.
#pragma once

#include <vector>

#include "harness/cut/constraint_source.h"
#include "methods/tools/thin_parts.h"

namespace cutbench {

class CutPolygons : public CuttingMethod, private ConstraintSource {
 public:
  struct Options {
    ThinParts thin;              ///< thinness of a part over the triangle that it is of; 0: nothing is merged
    double stabilisation = 0.5;  ///< tau > 0 (compound_sheet.h says what a value means)
  };
  explicit CutPolygons(const Options& options) : options_(options) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  const ConstraintSource* constraint_source() const override { return options_.thin.thinness > 0 ? this : nullptr; }

 private:
  ConstraintKind constraint_kind() const override { return ConstraintKind::polygons; }
  Constraints constraints(const Sheet& before, const Sheet& cut) const override;
  Constraints next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                               const PolygonsLeft& left) const override;

  std::vector<Polygon> stabilised(std::vector<Polygon> polygons) const;

  Options options_;
};

}  // namespace cutbench
