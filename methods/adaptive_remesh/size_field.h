// The edge length that adaptive_remesh asks for at a point: small at the tips of incisions, and growing with the
// distance from them up to the mean edge of the sheet,
//
//     s(p) = min(h, h_tip + g |p - nearest tip|).
//
// Source: an isotropic size field as in Narain, Samii and O'Brien 2012, there from curvature, velocity and
// contact; fine at the tips as in Pfaff, Narain, de Joya and O'Brien 2014, there from stress. g bounds the
// gradation (Borouchaki, Hecht and Frey 1998).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

class SizeField {
 public:
  /// Forgets all tips. Lengths in rest units. \pre 0 < at_tip <= far, growth > 0
  void begin(double far, double at_tip, double growth) {
    far_ = far;
    at_tip_ = at_tip;
    growth_ = growth;
    tips_.clear();
  }
  void add_tip(Point2 tip) { tips_.push_back(tip); }

  /// Farther from every tip, the field is `far`.
  double reach() const { return (far_ - at_tip_) / growth_; }

  double operator()(Point2 p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point2 tip : tips_) nearest = std::min(nearest, squared_length(p - tip));
    return std::min(far_, at_tip_ + growth_ * std::sqrt(nearest));
  }
  /// Length of the edge a b over the field at its middle.
  double relative_length(Point2 a, Point2 b) const {
    return std::sqrt(squared_length(b - a)) / (*this)(0.5 * a + 0.5 * b);
  }

 private:
  double far_ = 0, at_tip_ = 0, growth_ = 0;
  std::vector<Point2> tips_;
};

}  // namespace cutbench
