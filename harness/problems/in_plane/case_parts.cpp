#include "harness/problems/in_plane/case_parts.h"

#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/problems/common/members.h"

namespace cutbench {

Curve line(Point2 a, Point2 b) { return {Curve::Kind::polyline, false, {a, b}}; }

Curve arc(double radius, double from, double to) {
  const int pieces = to_int(std::ceil((to - from) / (22.5 * degree) - 1e-9));
  const double step = (to - from) / pieces, handle = 4.0 / 3 * std::tan(step / 4) * radius;
  const auto at = [&](double t) { return Point2{radius * std::cos(t), radius * std::sin(t)}; };
  const auto along = [&](double t) { return Point2{-handle * std::sin(t), handle * std::cos(t)}; };
  Curve curve{Curve::Kind::bezier, to - from >= 359 * degree, {at(from)}};
  for (int i = 0; i < pieces; ++i) {
    const double a = from + i * step, b = a + step;
    const Point2 end = curve.closed && i + 1 == pieces ? curve.points.front() : at(b);
    curve.points.insert(curve.points.end(), {at(a) + along(a), end - along(b), end});
  }
  return curve;
}

std::vector<LipSample> straight_lips(Point2 middle, double half_length) {
  std::vector<LipSample> samples;
  const double step = 2 * half_length / lip_samples;
  for (int i = 0; i < lip_samples; ++i)
    samples.push_back({middle + Point2{-half_length + (i + 0.5) * step, 0}, {0, 1}, step});
  return samples;
}

WindowTip straight_tip(Point2 at, double angle, const StressIntensity& k) {
  const auto modes = [=](const Axes& frame) {
    return williams_modes(sheet_material, {frame.to_rest({at.x, at.y}), frame.angle + angle});
  };
  return {{at, angle}, k, modes};
}

}  // namespace cutbench
