#include "harness/mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

double smallest_angle_deg(Point2 a, Point2 b, Point2 c) {
  const auto angles = angles_deg(a, b, c);
  return *std::min_element(angles.begin(), angles.end());
}

double largest_angle_deg(Point2 a, Point2 b, Point2 c) {
  const auto angles = angles_deg(a, b, c);
  return *std::max_element(angles.begin(), angles.end());
}

double smallest_altitude(Point2 a, Point2 b, Point2 c) {
  return twice_area(a, b, c) / std::sqrt(longest_squared(a, b, c));
}

}  // namespace cutbench
