// Stress intensity factors at the end of a straight cut, from a computed field.
#pragma once

#include "harness/fem/block_matrix.h"
#include "harness/fem/element_table.h"
#include "harness/truth/elastic_field.h"

namespace cutbench {

/// N/m of stress per thickness, times sqrt(m).
struct StressIntensity {
  double k1 = 0, k2 = 0;
};

/// The part of the sheet that is looked at: a ring round the tip, rest units. Fixed in the sheet and not in elements,
/// so that every method and every mesh is asked the same.
struct Ring {
  double inner = 0.06, outer = 0.2;
};

/// d u_i / d x_j in an element. \pre displacement has two values per slot.
Eigen::Matrix2d displacement_gradient(const Element& element, const Field& displacement);

/// Domain form of the interaction integral (Yau, Wang and Corten 1980; Shih and Asaro 1988), over the ring:
///   I = integral of (s_ij u'_i,1 + s'_ij u_i,1 - s_ij e'_ij delta_1j) q,_j,   K = E I / 2,
/// with ' of the Williams field of K = 1 and q falling smoothly from 1 to 0. The frame is the tip's, that is the
/// tangent of the requested curve, whatever edges a method opened. It is linear in the displacement: weights per
/// element are found once, for all fields on these elements.
class InteractionIntegral {
 public:
  /// \pre the cut is straight and free of traction inside the ring, no other tip and no border is in it.
  InteractionIntegral(const Sheet& sheet, const ElementTable& elements, const Elastic& elastic, const Tip& tip,
                      const Ring& ring = {});
  StressIntensity of(const ElementTable& elements, const Field& displacement) const;

 private:
  struct Weights {
    std::size_t element;
    Eigen::Matrix2d mode_1, mode_2;  ///< times the displacement gradient, entry by entry
  };
  std::vector<Weights> weights_;
};

}  // namespace cutbench
