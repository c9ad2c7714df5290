// The border and the requested paths as chains without sharp turns: what the legs of a forced corner run along.
#pragma once

#include <vector>

#include "harness/oracle/flatten.h"
#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// Segments end to end that nowhere turn by more than 45 degrees.
struct Chain {
  std::vector<PathSegment> segments;
  bool closed = false;  ///< the last segment goes on in the first
  bool curved = false;  ///< flattened from a Bezier curve
};

/// The border loops of an opened sheet, each lip of an incision included, with the sheet on their left.
/// Precondition: a manifold, no bow-ties.
std::vector<Chain> border_chains(const Mesh& mesh);

/// One or more chains per curve, flattened to `tolerance` (rest units).
/// Throws what flatten() throws.
std::vector<Chain> path_chains(const std::vector<Curve>& cuts, double tolerance);

/// Walks along a chain, away from a point of it.
class Walker {
 public:
  /// Starts at `start`, which lies on segment `index`. The chain must outlive the walker.
  Walker(const Chain& chain, int index, bool forward, const Point& start);

  /// Goes `length` further (rest units) and returns how far it came: less, where the chain ends. A closed chain ends
  /// where the walk began.
  double advance(double length);

  const Point& position() const { return position_; }

 private:
  const Chain& chain_;
  int index_;
  bool forward_;
  int segments_left_;  // not yet begun
  Point position_;
};

}  // namespace cutbench::oracle
