// Cuts that depend on the sheet's extent alone, drawn on the unit square.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/cases/cut_generator.h"

namespace cutbench {

namespace {

Point2 bezier_point(const Points& p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

bool has_crossing(const Points& p) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j) {
      const Point2 a = p[i], b = p[i + 1], c = p[j], d = p[j + 1];
      if (cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0) return true;
    }
  return false;
}

}  // namespace

bool Generator::is_smooth(const Points& p, bool stays_inside) {
  constexpr int n = 64;
  constexpr double radius = 0.05;
  Points points;
  for (int k = 0; k <= n; ++k) {
    const double t = to_double(k) / n, s = 1 - t;
    const Point2 velocity = 3 * s * s * (p[1] - p[0]) + 6 * s * t * (p[2] - p[1]) + 3 * t * t * (p[3] - p[2]);
    const Point2 acceleration = 6 * s * (p[2] - 2 * p[1] + p[0]) + 6 * t * (p[3] - 2 * p[2] + p[1]);
    const double speed2 = squared_length(velocity);
    if (speed2 * std::sqrt(speed2) < radius * std::abs(cross(velocity, acceleration))) return false;
    points.push_back(bezier_point(p, t));
    const Point2 q = points.back();
    if (stays_inside && k > 0 && k < n && std::min({q.x, q.y, 1 - q.x, 1 - q.y}) <= 0) return false;
  }
  return !has_crossing(points);
}

Curve Generator::smooth(Ends ends, bool stays_inside) {
  auto [from, to] = ends;
  while (squared_length(to - from) < 0.25 * 0.25) to = inside();
  for (;;) {
    const Points points{from,
                        {random_.between(-0.1, 1.1), random_.between(-0.1, 1.1)},
                        {random_.between(-0.1, 1.1), random_.between(-0.1, 1.1)},
                        to};
    if (is_smooth(points, stays_inside)) return bezier(points);
  }
}

/// Eight points about a centre, joined with Catmull and Rom's tangents.
Curve Generator::blob(Point2 centre, double radius) {
  const double d = std::sqrt(0.5);
  const Point2 eighths[] = {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}};
  const Point2 turn = random_.direction();
  Points at;
  for (Point2 e : eighths) {
    const double r = radius * random_.between(0.8, 1.2);
    at.push_back({centre.x + r * (turn.x * e.x - turn.y * e.y), centre.y + r * (turn.y * e.x + turn.x * e.y)});
  }
  Points points{at[0]};
  for (std::size_t k = 0; k < 8; ++k) {
    const auto p = [&](std::size_t step) { return at[(k + step) % 8]; };
    points.push_back(p(0) + 1.0 / 6 * (p(1) - p(7)));
    points.push_back(p(1) - 1.0 / 6 * (p(2) - p(0)));
    points.push_back(p(1));
  }
  return bezier(std::move(points), true);
}

Curves Generator::cut_out() {
  const double radius = random_.between(0.06, 0.25);
  Point2 centre{random_.between(0.35, 0.65), random_.between(0.35, 0.65)};
  if (const double depth = random_.between(-0.5, 0.5) * radius; i_ % 4 == 3) centre = on(any_side(), depth);
  return {placed(blob(centre, radius))};
}

Curves Generator::recut() {
  Curves cuts{placed(smooth({on(left), on(right)}, true)), placed(smooth({on(bottom), on(top)}, true))};
  if (random_.coin()) std::swap(cuts[0], cuts[1]);
  return cuts;
}

Curves Generator::several() {
  Curves cuts;
  while (cuts.size() < 4) {
    constexpr Curves (Generator::*kinds[])() = {&Generator::straight, &Generator::curved, &Generator::partial,
                                                &Generator::border_inward, &Generator::cut_out};
    cuts.push_back((this->*kinds[random_.below(5)])().front());
  }
  return cuts;
}

/// Every step-th corner of a regular octagon or pentagon about the centre, turned at random.
Curve Generator::ring(Point2 centre, double radius, std::size_t corners, std::size_t step) {
  // cos and sin of 72 degrees, to the last digit; no sines, which differ between machines.
  const Point2 fifth{0.30901699437494742, 0.95105651629515357}, eighth{std::sqrt(0.5), std::sqrt(0.5)};
  const Point2 turn = corners == 5 ? fifth : eighth;
  Points all{random_.direction()}, points;
  while (all.size() < corners) {
    const Point2 p = all.back();
    all.push_back({turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y});
  }
  for (std::size_t k = 0; k < corners; ++k) points.push_back(centre + radius * all[k * step % corners]);
  return polyline(std::move(points), true);
}

Curves Generator::self_crossing() {
  const Point2 centre{random_.between(0.35, 0.65), random_.between(0.35, 0.65)}, u = random_.direction();
  const double size = random_.between(0.1, 0.3);
  const auto at = [&](double x, double y) { return centre + size * Point2{x * u.x - y * u.y, x * u.y + y * u.x}; };
  switch (i_ % 3) {
    case 0:
      return {placed(bezier({at(-1, -0.7), at(3, 1.5), at(-3, 1.5), at(1, -0.7)}))};
    case 1:
      return {placed(ring(centre, size, 5, 2))};
    default:  // starts where it crosses itself
      return {placed(
          bezier({at(0, 0), at(1.2, 1.2), at(1.2, -1.2), at(0, 0), at(-1.2, 1.2), at(-1.2, -1.2), at(0, 0)}, true))};
  }
}

}  // namespace cutbench
