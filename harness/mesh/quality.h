// Shape of rest triangles. Lengths are in rest units, angles in degrees.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/types.h"

namespace cutbench {

// Each function below takes the corners in either order round the triangle, with edges between 1e-150 and 1e60 long.

/// l_max / (height on it) = l_max^2 / (2 area): equilateral 2/sqrt(3) = 1.1547, right isosceles 2; inf for zero area.
double aspect_ratio(Point2 a, Point2 b, Point2 c);

/// The interior angles at a, b, c, in degrees.
std::array<double, 3> angles_deg(Point2 a, Point2 b, Point2 c);
double smallest_angle_deg(Point2 a, Point2 b, Point2 c);
double largest_angle_deg(Point2 a, Point2 b, Point2 c);

/// The height on the longest edge.
double smallest_altitude(Point2 a, Point2 b, Point2 c);

/// Over a list of triangles; all zero for an empty list.
struct Quality {
  double ar_max = 0, ar_mean = 0;  ///< aspect ratio
  double ar_p99 = 0;  ///< nearest rank: the smallest aspect ratio that at least 99 % of the triangles don't exceed
  double angle_min_deg = 0, angle_max_deg = 0;
  double altitude_min = 0;
  std::size_t over_3 = 0;  ///< triangles of aspect ratio > 3
  std::size_t triangles = 0;
};

inline Quality quality(std::span<const std::array<Point2, 3>> triangles) {
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
    q.angle_min_deg = std::min(q.angle_min_deg, smallest_angle_deg(a, b, c));
    q.angle_max_deg = std::max(q.angle_max_deg, largest_angle_deg(a, b, c));
    q.altitude_min = std::min(q.altitude_min, smallest_altitude(a, b, c));
  }
  q.ar_mean = sum / to_double(q.triangles);
  const auto rank = to_index((99 * q.triangles + 99) / 100);  // ceil(0.99 n), counted from 1
  std::nth_element(ratios.begin(), ratios.begin() + (rank - 1), ratios.end());
  q.ar_p99 = ratios[to_size(rank - 1)];
  return q;
}

}  // namespace cutbench
