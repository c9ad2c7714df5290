#include "harness/mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace cutbench {

namespace {

double longest_squared(Point2 a, Point2 b, Point2 c) {
  return std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
}

double twice_area(Point2 a, Point2 b, Point2 c) { return std::abs(cross(b - a, c - a)); }

double angle_deg(Point2 apex, Point2 b, Point2 c) {
  return std::atan2(std::abs(cross(b - apex, c - apex)), dot(b - apex, c - apex)) * (180 / std::numbers::pi);
}

}  // namespace

double aspect_ratio(Point2 a, Point2 b, Point2 c) { return longest_squared(a, b, c) / twice_area(a, b, c); }

std::array<double, 3> angles_deg(Point2 a, Point2 b, Point2 c) {
  return {angle_deg(a, b, c), angle_deg(b, c, a), angle_deg(c, a, b)};
}

double smallest_angle_deg(Point2 a, Point2 b, Point2 c) { return std::ranges::min(angles_deg(a, b, c)); }

double largest_angle_deg(Point2 a, Point2 b, Point2 c) { return std::ranges::max(angles_deg(a, b, c)); }

double smallest_altitude(Point2 a, Point2 b, Point2 c) {
  return twice_area(a, b, c) / std::sqrt(longest_squared(a, b, c));
}

Quality quality(std::span<const std::array<Point2, 3>> triangles) {
  Quality q;
  if (triangles.empty()) return q;
  q.triangles = triangles.size();
  q.angle_min_deg = q.altitude_min = std::numeric_limits<double>::infinity();
  std::vector<double> ratios;
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    ratios.push_back(aspect_ratio(a, b, c));
    sum += ratios.back();
    q.ar_max = std::max(q.ar_max, ratios.back());
    q.over_3 += ratios.back() > 3;
    const auto [smallest, largest] = std::ranges::minmax(angles_deg(a, b, c));
    q.angle_min_deg = std::min(q.angle_min_deg, smallest);
    q.angle_max_deg = std::max(q.angle_max_deg, largest);
    q.altitude_min = std::min(q.altitude_min, smallest_altitude(a, b, c));
  }
  q.ar_mean = sum / static_cast<double>(q.triangles);
  const auto rank = static_cast<std::ptrdiff_t>((99 * q.triangles + 99) / 100);  // ceil(0.99 n), counted from 1
  std::nth_element(ratios.begin(), ratios.begin() + (rank - 1), ratios.end());
  q.ar_p99 = ratios[static_cast<std::size_t>(rank - 1)];
  return q;
}

}  // namespace cutbench
