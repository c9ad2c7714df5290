// The audit of forced zones (docs/explanation/measuring.md): where the input itself prevents good triangles.
//
// Computed from the sheet before the cut and the requested path alone; a method does not influence what it is excused
// for. An aspect ratio below 3 needs every angle above asin(1/3).
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// A point where two directions of border, older incisions and path enclose less than asin(1/3) of the sheet.
struct ForcedCorner {
  Point apex;
  Point leg1, leg2;  ///< unit tangents away from the apex; leg2 is counter-clockwise of leg1
  double angle;      ///< between them, radians; 0 at a cusp or a touch
  /// Closed polygon between the two legs, from the apex to where points equally far along them are 0.3 h apart, or one
  /// leg ends or turns by more than 45 degrees.
  std::vector<Point> wedge;
  /// How near to the apex a mesh vertex must be to stand for it: where two flattenings of a Bezier curve (1e-3 h) may
  /// put the same crossing, at most 0.1 h; 1e-6 h between straight legs.
  double apex_tolerance;
};

/// All forced corners: crossings and contacts of the paths with border, older incisions, each other and themselves,
/// sharp corners of the paths and of the border itself. Legs still within 1e-9 h of each other at 0.05 h from the apex
/// (a path along an edge) count as one leg, not as a corner. Where a curve dips out of the sheet and back within 1e-4
/// h, each of the two corners may be listed twice.
/// @param before  the sheet before the cut, opened; a manifold without bow-ties
/// @param cuts    requested curves, rest space
/// @param h       mean rest edge of the uncut sheet, > 0
/// Throws std::invalid_argument for a malformed curve (see flatten.h).
std::vector<ForcedCorner> forced_corners(const Mesh& before, const std::vector<Curve>& cuts, double h);

/// Which triangles of a result are excused.
struct ForcedZones {
  std::vector<char> in_corner;  ///< #T: has an apex as a vertex and lies between its legs (exempt even when strict)
  std::vector<char> in_zone;    ///< #T: in_corner, or its centroid lies in a wedge or within 0.25 h of an apex
  std::vector<char> near_zone;  ///< #T: in_zone, or its centroid lies within 0.02 h of a wedge: between incisions that
                                ///< lie beside their curves, within the tolerance, where the curves force a needle
  int corner_triangles = 0, zone_triangles = 0;
  double corner_area = 0, zone_area = 0;  ///< rest units squared; each triangle counts once
};

/// Precondition: indices of `after` are in range.
ForcedZones forced_zones(const std::vector<ForcedCorner>& corners, const Mesh& after, double h);

}  // namespace cutbench::oracle
