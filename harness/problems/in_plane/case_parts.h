// What window problems are made of: curves, samples of their lips, and their ends.
#pragma once

#include "harness/problems/in_plane/window_problem.h"

namespace cutbench {

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr int lip_samples = 400;  ///< of a cut

Curve line(Point2 a, Point2 b);
/// An arc round the origin as cubic Beziers, each so short that it is within 1e-7 of the radius.
Curve arc(double radius, double from, double to);
/// Of a cut along the x axis.
std::vector<LipSample> straight_lips(Point2 middle, double half_length);
/// An end of a straight cut.
WindowTip straight_tip(Point2 at, double angle, const StressIntensity& k);

}  // namespace cutbench
