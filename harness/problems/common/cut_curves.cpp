#include "harness/problems/common/cut_curves.h"

#include <cmath>

#include "harness/base/conversions.h"

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

}  // namespace cutbench
