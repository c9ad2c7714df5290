// A sheet in equilibrium out of its plane: what the problems with bending share. SI units.
//
// "Solved" is Newton's decrement at 1e-8 of the energy or less (Stepper), not a small residual: forces of slivers
// cancel no better than 1e-5 to 1e-3 of the whole in doubles. Where slivers keep Newton from that, too, the row has
// failed.
//
// What each problem compares with, formula and source, is at the top of its file; the elastica's numbers are in
// heavy_elastica.h. Tests give them a bending energy other than `patches` to show what a wrong one does.
#pragma once

#include <functional>

#include "harness/base/conversions.h"
#include "harness/fem/time/stepper.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

/// Where a vertex of the opened sheet begins, and on which axes it is held there.
struct Start {
  Point3 position;  ///< m
  std::array<bool, 3> held{};
};

/// Newton's method with a line search starts from the positions of `start`. It needs a few iterations from near the
/// expected shape and about twenty from a flat sheet; the equilibrium is the same (tests/out_of_plane_truth_test.cpp).
class BentSheet {
 public:
  /// One pin for each held rest vertex, so `start` must hold all copies of it or none on an axis. Gravity pulls along
  /// -z. Of `constraints` the merged triangles count. \pre fewer than 32767 held rest vertices.
  BentSheet(const Sheet& sheet, const Material& material, BendingKind bending, double gravity,
            const std::function<Start(DeformedIndex)>& start, const Constraints& constraints = {});

  /// Adds what it took to `answer`: `iterations` are Newton's, `residual` is the last one's, of the forces. False where
  /// there is no equilibrium, which is then the verdict.
  bool solve_to_equilibrium(const SolverOptions& solver, Answer& answer);

  // --- after solve_to_equilibrium() ----------------------------------------------------------------------------------
  Point3 position(DeformedIndex d) const;  ///< m
  Energy energy();
  /// J: of these positions instead.
  double bending_energy(const std::function<Point3(DeformedIndex)>& position);
  /// N: what holds the vertex on its held axes, with the sheet's weight there.
  Point3 support(DeformedIndex d) const;
  double mass(DeformedIndex d) const { return model_.lumped_mass()[to_index(d())]; }
  bool held(DeformedIndex d) const { return model_.pinned(3 * d()); }  ///< along x

 private:
  const Sheet& sheet_;
  Model<3> model_;
  State state_;
  Field force_;  // of the sheet and its weight on its vertices
};

/// Vertices of the opened sheet that triangles use.
std::vector<DeformedIndex> vertices_in_use(const Sheet& sheet);
/// Edges from the border of the unit square, not from what a cut opened or deleted, per vertex of the opened sheet, up
/// to `most`.
std::vector<int> rings_from_border(const Sheet& sheet, int most);
/// How many vertices of the opened sheet each rest vertex has become.
std::vector<int> copies_of_vertices(const Sheet& sheet);
/// Per slot: the centroid of the largest triangle at each vertex of the opened sheet, in rest space. It tells on which
/// side of an incision the vertex is.
std::vector<Point2> sides(const Sheet& sheet);

/// In the specimen's frame.
Point2 to_frame(const Specimen& specimen, Point2 rest);
Point2 from_frame(const Specimen& specimen, Point2 p);

/// Relative to `exact`.
Measure compared(std::string name, double value, double exact);

}  // namespace cutbench
