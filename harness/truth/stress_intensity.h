// Stress intensity factors at the end of a cut, from a computed field.
#pragma once

#include <array>

#include "harness/fem/block_matrix.h"
#include "harness/fem/element_table.h"
#include "harness/truth/exact_fields.h"

namespace cutbench {

/// The end of a cut, and where it was going.
struct Tip {
  Point2 at;
  double angle = 0;      ///< of the tangent of the requested curve, pointing out of it into the whole sheet
  double curvature = 0;  ///< of that curve: left turns are positive
};

/// A field without traction on the cut, and its intensity at the tip.
struct Mode {
  ElasticField field;
  StressIntensity k;
};

/// Those of a straight cut.
std::array<Mode, 2> williams_modes(const Elastic& elastic, const Tip& tip);

/// The part of the sheet that is looked at: a ring round the tip, rest units. Fixed in the sheet and not in elements,
/// so that every method and every mesh is asked the same.
struct Ring {
  double inner = 0.06, outer = 0.2;
};

/// d u_i / d x_j in an element. \pre displacement has two values per slot.
Eigen::Matrix2d displacement_gradient(const Element& element, const Field& displacement);
/// The displacement in a triangle: its own linear field, or that of the polygon of which it is a member.
struct LinearDisplacement {
  Eigen::Vector2d at_corner;  ///< 0
  Eigen::Matrix2d gradient;
};
LinearDisplacement displacement_in(const ElementTable& elements, std::size_t triangle, const Field& displacement);

/// Domain form of the interaction integral (Yau, Wang and Corten 1980; Shih and Asaro 1988), in the frame of the
/// requested curve, whatever edges a method opened:
///   I = integral of s_ij g'_ij + s'_ij g_ij - s_ij e'_ij div V,  g_ij = u_i,k V_k,j - (q w u)_i,j,
/// with ' of each mode, and 2 / E (K1 K1' + K2 K2') = I. V = q (t + w (p - tip)) is how the cut grows: along a straight
/// one (w = 0, t its tangent), on an arc as the rotation w about its centre, so that lips move along themselves and
/// need no terms of their own; q falls smoothly from 1 to 0 over the ring. The displacement is turned along, which
/// changes nothing in equilibrium, and leaves nothing to integrate where q = 1, next to the tip. It is linear in the
/// displacement: weights per element are found once, for all fields on these elements.
class InteractionIntegral {
 public:
  /// \pre inside the ring the cut is straight or an arc, as the tip says, and free of traction; no other tip and no
  /// border is in it. The intensities of the modes are independent.
  InteractionIntegral(const Sheet& sheet, const ElementTable& elements, const Elastic& elastic, const Tip& tip,
                      const std::array<Mode, 2>& modes, const Ring& ring = {});
  StressIntensity of(const ElementTable& elements, const Field& displacement) const;

 private:
  /// Of one mode: times the displacement gradient, and times the displacement of the element's first corner.
  struct Weight {
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  };
  struct Weights {
    std::size_t element;
    std::array<Weight, 2> mode;
  };
  std::vector<Weights> weights_;
  Eigen::Matrix2d to_intensity_;  // from the integrals of both modes
};

}  // namespace cutbench
