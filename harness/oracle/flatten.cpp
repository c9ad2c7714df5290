#include "harness/oracle/flatten.h"

#include <stdexcept>

namespace cutbench::oracle {
namespace {

using Cubic = std::array<Point, 4>;

void require_valid(const Curve& curve) {
  for (const Point& p : curve.points)
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) throw std::invalid_argument("a path point is not finite");
  if (curve.points.empty()) throw std::invalid_argument("a path has no points");
  if (curve.bezier && curve.points.size() % 3 != 1) throw std::invalid_argument("a Bezier path needs 3 k + 1 points");
  if (curve.bezier && curve.closed && curve.points.front() != curve.points.back())
    throw std::invalid_argument("a closed Bezier path must end where it began");
}

std::array<Cubic, 2> halves(const Cubic& c) {
  const Point ab = between(c[0], c[1], 0.5), bc = between(c[1], c[2], 0.5), cd = between(c[2], c[3], 0.5);
  const Point abc = between(ab, bc, 0.5), bcd = between(bc, cd, 0.5), middle = between(abc, bcd, 0.5);
  return {Cubic{c[0], ab, abc, middle}, Cubic{middle, bcd, cd, c[3]}};
}

/// Direction in which the cubic leaves its first point: towards the first control point that differs from it.
Point start_tangent(const Cubic& c) {
  for (int i = 1; i < 4; ++i)
    if (c[i] != c[0]) return direction(c[0], c[i]);
  return {0, 0};
}

Point end_tangent(const Cubic& c) {
  const Point t = start_tangent({c[3], c[2], c[1], c[0]});
  return {-t[0], -t[1]};
}

void flatten(const Cubic& c, double tolerance, int depth, std::vector<PathSegment>& out) {
  const Segment chord{c[0], c[3]};
  const bool flat = distance(c[1], chord) <= tolerance && distance(c[2], chord) <= tolerance;
  if (flat || depth == 0) {
    if (c[0] != c[3]) out.push_back({chord, start_tangent(c), end_tangent(c)});
    return;
  }
  for (const Cubic& half : halves(c)) flatten(half, tolerance, depth - 1, out);
}

}  // namespace

std::vector<PathSegment> flatten(const Curve& curve, double tolerance) {
  require_valid(curve);
  const std::vector<Point>& p = curve.points;
  std::vector<PathSegment> out;
  if (curve.bezier) {
    constexpr int deepest = 24;  // each halving divides the error by four: 4^24 is beyond double
    for (std::size_t i = 0; i + 3 < p.size(); i += 3)
      // A curve that is small itself keeps its shape.
      flatten(Cubic{p[i], p[i + 1], p[i + 2], p[i + 3]},
              std::min(tolerance,
                       1e-3 * std::max({distance(p[i], p[i + 1]), distance(p[i], p[i + 2]), distance(p[i], p[i + 3])})),
              deepest, out);
    return out;
  }
  const std::size_t count = curve.closed ? p.size() : p.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Segment s{p[i], p[(i + 1) % p.size()]};
    if (s[0] == s[1]) continue;
    const Point d = direction(s[0], s[1]);
    out.push_back({s, d, d});
  }
  return out;
}

}  // namespace cutbench::oracle
