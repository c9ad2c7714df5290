// A blade that advances along a curve: the part of the curve between two distances from its beginning, so that a curve
// can be cut part by part while the sheet moves (Xin et al. 2018, 4.2, steps i and i + 1).
#pragma once

#include <cstddef>
#include <vector>

#include "harness/path/curve.h"

namespace cutbench {

class Blade {
 public:
  /// \pre check_curve(curve)
  explicit Blade(Curve curve);

  /// Of the curve, rest units. Distances along a Bezier are those along 256 chords of it, all of equal steps of its
  /// parameter: short of its length by less than 1e-4 of it where it has no sharp return.
  double length() const { return ends_.empty() ? 0 : ends_.back(); }
  /// The part between two distances, an open curve of the same kind. It ends at exactly the point (bit-equal) where the
  /// next part begins; the first and the last part end at the ends of the curve. A part of a Bezier is exact (de
  /// Casteljau's subdivision). \pre 0 <= from < to <= length()
  Curve part(double from, double to) const;

 private:
  /// On which line or Bezier, and where on it, 0 to 1.
  struct Place {
    std::size_t piece;
    double t;
  };
  Place place_at(double distance) const;
  const Point2* piece(std::size_t i) const { return &curve_.points[i * step_]; }

  Curve curve_;               ///< open; a closed polyline goes back to its first point
  std::size_t step_;          ///< points from one piece to the next
  int chords_;                ///< of a piece
  std::vector<double> ends_;  ///< distance travelled at the end of each chord
};

}  // namespace cutbench
