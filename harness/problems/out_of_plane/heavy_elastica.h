// The shape of an inextensible strip clamped level at one end and hanging under its own weight.
#pragma once

#include <vector>

namespace cutbench {

/// D th'' = -q (L - s) cos th, th(0) = 0, th'(L) = 0, where s is the length along the strip, th its angle below the
/// horizontal, q its weight per area and D its rigidity (Euler's elastica under distributed weight: Love, A treatise on
/// the mathematical theory of elasticity, 4th ed., 262-263). Solved by shooting from the free end with Runge and
/// Kutta's fourth order, to 1e-9 L.
class HeavyElastica {
 public:
  /// \pre length > 0; 0 <= load = q L^3 / D <= 50.
  HeavyElastica(double length, double load);

  struct Section {
    double x, z;   ///< from the clamp, z upwards, so never above 0
    double angle;  ///< below the horizontal, radians
  };
  /// Straight before the clamp (s < 0) and beyond the end (s > L), where it carries nothing.
  Section at(double s) const;
  double length() const { return length_; }

 private:
  double length_;
  std::vector<Section> sections_;  // at equal steps from 0 to L
};

}  // namespace cutbench
