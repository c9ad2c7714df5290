#include "harness/path/curve.h"

#include <algorithm>
#include <cmath>

#include "harness/base/errors.h"

namespace cutbench {

namespace {

Point2 bezier_point(const Point2* p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

/// Where in [a, b] a cubic is slowest: at the far end of a sharp return.
double slowest_between(const Point2* p, double a, double b) {
  const auto speed2 = [p](double t) {
    const double s = 1 - t;
    return squared_length(s * s * (p[1] - p[0]) + 2 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
  };
  for (int i = 0; i < 100; ++i) {
    const double u = a + (b - a) / 3, v = b - (b - a) / 3;
    (speed2(u) < speed2(v) ? b : a) = speed2(u) < speed2(v) ? v : u;
  }
  return a + (b - a) / 2;
}

/// Two Beziers meet at `joint` with the tangents' directions more than 0.06 degrees apart.
bool is_kink(Point2 before, Point2 joint, Point2 after) {
  const Point2 in = joint - before, out = after - joint;
  return dot(in, out) <= 0 || std::abs(cross(in, out)) > 1e-3 * dot(in, out);
}

void add(Polyline& out, Point2 p, bool kept, double snap) {
  if (!out.points.empty() && within(p, out.points.back(), snap)) {
    out.kept.back() |= static_cast<std::uint8_t>(kept);
    return;
  }
  out.points.push_back(p);
  out.kept.push_back(kept);
}

void flatten_bezier(const Curve& curve, double tolerance, double snap, Polyline& out) {
  const auto& c = curve.points;
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 3 < n; i += 3) {
    const Point2* p = &c[i];
    const double bend = std::max(squared_length(p[0] - 2 * p[1] + p[2]), squared_length(p[1] - 2 * p[2] + p[3]));
    // A curve that is small itself keeps its shape.
    const double size2 =
        std::max({squared_length(p[1] - p[0]), squared_length(p[2] - p[0]), squared_length(p[3] - p[0])});
    const double finest = std::min(tolerance, 0.01 * std::sqrt(size2));
    const double steps = bend > 0 ? std::clamp(std::ceil(std::sqrt(0.75 * std::sqrt(bend) / finest)), 1.0, 1e6) : 1;
    const bool tip = i == 0 && !curve.closed;
    const bool kink = i == 0 ? is_kink(c[n - 2], c[0], c[1]) : is_kink(c[i - 1], c[i], c[i + 1]);
    add(out, p[0], tip || kink, snap);
    Point2 before = p[0] - (p[1] - p[0]), from = p[0], to = bezier_point(p, 1 / steps);
    for (double k = 1; k <= steps; ++k) {
      const Point2 after = k < steps ? bezier_point(p, (k + 1) / steps) : p[3] + (p[3] - p[2]);
      // A sharp return goes all its way, though a chord that cuts it off strays by less than the tolerance.
      if (dot(from - before, after - to) < 0)
        add(out, bezier_point(p, slowest_between(p, (k - 1) / steps, k / steps)), false, snap);
      if (k < steps) add(out, to, false, snap);
      before = from;
      from = to;
      to = after;
    }
  }
  if (!curve.closed) add(out, c.back(), true, snap);
}

}  // namespace

void flatten(const Curve& curve, double tolerance, double snap, Polyline& out) {
  out.points.clear();
  out.kept.clear();
  out.closed = curve.closed;
  out.curved = curve.kind == Curve::Kind::bezier;
  out.continues = curve.continues;
  out.goes_on = curve.goes_on;
  if (curve.kind == Curve::Kind::bezier)
    flatten_bezier(curve, tolerance, snap, out);
  else
    for (Point2 p : curve.points) add(out, p, true, snap);
  if (!out.closed || out.points.size() < 2) return;
  if (within(out.points.back(), out.points.front(), snap)) {  // the closing step has a length, too
    out.points.pop_back();
    out.kept.pop_back();
  }
}

void check_curve(const Curve& curve, const std::string& name) {
  const std::size_t n = curve.points.size();
  const bool bezier = curve.kind == Curve::Kind::bezier;
  if (bezier && (n < 4 || n % 3 != 1))
    throw InputError(name + ": a chain of cubic Beziers has 4, 7, 10, ... points, this one has " + std::to_string(n));
  if (!bezier && n < (curve.closed ? 3u : 2u))
    throw InputError(name + ": a polyline needs at least " + (curve.closed ? "3 points when closed" : "2 points") +
                     ", this one has " + std::to_string(n));
  for (std::size_t i = 0; i < n; ++i)
    for (double c : {curve.points[i].x, curve.points[i].y})
      if (!std::isfinite(c) || std::abs(c) > 1e60)
        throw InputError(name + ", point " + std::to_string(i) + ": coordinates must be finite and below 1e60");
  if (bezier && curve.closed && curve.points.front() != curve.points.back())
    throw InputError(name + ": a closed Bezier must end where it began; repeat its first point at the end");
}

}  // namespace cutbench
