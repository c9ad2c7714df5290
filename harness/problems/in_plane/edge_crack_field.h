// The field of a strip with a cut from its edge, in tension. No formula is known for it: it is a sum of functions that
// are exact in the strip and on the lips, and that fit on the border.
#pragma once

#include "harness/problems/common/exact_fields.h"

namespace cutbench {

inline constexpr int edge_crack_height = 4;  ///< of the strip, in widths: longer makes no difference

/// A strip of width 1 and height 4 that `stress` (N/m) pulls at both ends, cut from the middle of its left side to
/// `depth`. The frame's origin is the tip; its x axis points away from the cut.
///   phi = sqrt(z) p + q,  psi = sqrt(z) p - q - z phi',
/// with p and q real on the x axis and analytic in the strip: whatever they are, the lips are free, and the field is
/// its own mirror image. Both are sums of
/// - polynomials up to degree 36, Chebyshev's along the strip's axis, turned by a right angle;
/// - poles behind the mouth, that crowd towards it: in its two corners the field is not analytic;
/// - powers up to 6 of 1 / (z - z0): the strip is continued over its right side, where the cut has its mirror image,
///   and z0 is in the middle of that.
/// Their coefficients are the least squares of the tractions on the border. With other numbers of terms the gape is the
/// same to 2e-7 of its norm, and K1 likewise, for depths of 0.2 to 0.5; 1e-6 up to 0.6; 1e-4 at 0.75. Tractions are
/// off by at most 7e-6 of the pull up to 0.5, in the corners at the ends, which the lips hardly feel.
/// Source: the boundary collocation of Gross, Srawley and Brown, NASA TN D-2395 (1964), not read but for the beginning
/// of its summary. They fit Williams's series, which is the same phi with powers of z alone: 81 of those leave K1 2 to
/// 7 percent off. Poles that crowd towards corners: Gopal and Trefethen, SIAM J. Numer. Anal. 57 (2019); not read.
/// \pre 0 < depth < 1
ElasticField edge_crack_field(const Elastic& elastic, const Axes& frame, double depth, double stress);

}  // namespace cutbench
