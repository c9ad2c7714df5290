// The curves that problems cut along.
#pragma once

#include <numbers>

#include "harness/path/curve.h"

namespace cutbench {

inline constexpr double degree = std::numbers::pi / 180;

Curve line(Point2 a, Point2 b);
/// An arc round the origin as cubic Beziers, each so short that it is within 1e-7 of the radius.
Curve arc(double radius, double from, double to);

}  // namespace cutbench
