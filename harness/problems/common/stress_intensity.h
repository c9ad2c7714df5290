// Stress intensity factors at the end of a cut, from a computed field.
#pragma once

#include <array>
#include <optional>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/tips/tip_functions.h"
#include "harness/problems/common/exact_fields.h"

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
/// The displacement in a triangle: its own linear field, or the linear part of the compound's.
LinearPart<2> displacement_in(const ElementTable& elements, std::size_t triangle, const Field& displacement);

/// K at the end of a cut from the coefficients of the tip functions there: sin(theta/2) alone jumps across the cut, and
/// the lips are 8 K / E sqrt(r / 2 pi) apart (Williams 1957), so K = E sqrt(2 pi) / 4 c_0, K1 normal to the cut and K2
/// along it. Nothing where no tip with functions is within `reach`.
std::optional<StressIntensity> intensity_of_coefficients(const TipFunctions& functions, const Eigen::VectorXd& c,
                                                         const Tip& tip, const Elastic& elastic, double reach);

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
  /// \param functions  null: the field has none
  InteractionIntegral(const Sheet& sheet, const ElementTable& elements, const Elastic& elastic, const Tip& tip,
                      const std::array<Mode, 2>& modes, const Ring& ring = {}, const TipFunctions* functions = nullptr);
  /// \param of_tips  coefficients of the tip functions; empty: there are none in this field
  StressIntensity of(const ElementTable& elements, const Field& displacement,
                     const Eigen::VectorXd& of_tips = {}) const;

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
  void add_functions(std::size_t mode, const TipFunctions& functions, TriangleIndex t, Point2 p,
                     const Eigen::Matrix2d& of_gradient, const Eigen::Vector2d& of_value);

  std::vector<Weights> weights_;
  Eigen::Matrix2Xd of_functions_;  // the integrals of both modes, per coefficient of a tip function
  Eigen::Matrix2d to_intensity_;   // from the integrals of both modes
};

}  // namespace cutbench
