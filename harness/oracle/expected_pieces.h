// How many pieces a sheet must have after a cut: from the sheet's border, its older incisions and the path alone.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// Numbers of pieces. They differ only where the answer hangs on something smaller than the tolerances: a path that
/// ends that near to something, or a piece that thin.
struct ExpectedPieces {
  /// Open ends as they are, pieces thinner than `tip` left out.
  int expected = 0;
  /// Pieces thinner than `thin` left out, too, and one less for each
  /// - face, inside the sheet or outside, that is thinner than `touch`: the lines round it may not cross at all;
  /// - point of a path within `tip` of another piece of that path;
  /// - end of a path at the tip of an older incision and within `touch` of another line;
  /// - tip of an older incision within `touch` of a path, but no more of them than crossings of path and incisions;
  /// - time that a path comes within `touch` of an older line and turns back, where `touch` exceeds `tip`;
  /// - time that it passes within `touch` of a corner of older lines which all lie on one side of it, likewise.
  int least = 0;
  /// Open ends lengthened by `tip`, what passes within `touch` of the path joined to it, however thin the pieces; and
  /// one more for each
  /// - stretch of a path that runs within `touch` of another piece of it: between two such points they may cross;
  /// - segment of a path so small (8 `touch`) that it nearly touches itself everywhere.
  int most = 0;
};

/// Rest units.
struct PieceTolerances {
  double tip = 0, touch = 0, thin = 0;  ///< 0 <= tip <= touch <= thin
};

/// Counts the faces inside the sheet of the exact planar arrangement of all given segments (planar_map.h).
/// Inside is where a walk from the unbounded face has crossed an odd number of border edges. The thickness of a face is
/// 2 area / perimeter.
/// @param border     border edges of the sheet, each once
/// @param incisions  older incisions, each pair of lips once: both sides are inside
/// @param paths      flattened requested curves, each a chain, closed where its last point is its first
/// Precondition: no segment has zero length.
ExpectedPieces expected_pieces(const std::vector<Segment>& border, const std::vector<Segment>& incisions,
                               const std::vector<std::vector<Segment>>& paths, const PieceTolerances& tolerances);

}  // namespace cutbench::oracle
