// What window problems are made of: samples of lips, and ends of cuts.
#pragma once

#include "harness/problems/common/cut_curves.h"
#include "harness/problems/in_plane/window_problem.h"

namespace cutbench {

inline constexpr int lip_samples = 400;  ///< of a cut

/// Of a cut along the x axis.
std::vector<LipSample> straight_lips(Point2 middle, double half_length);
/// An end of a straight cut.
WindowTip straight_tip(Point2 at, double angle, const StressIntensity& k);

}  // namespace cutbench
