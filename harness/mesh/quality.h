// Shape of rest triangles. Lengths are in rest units, angles in degrees.
#pragma once

#include <array>
#include <cstddef>
#include <span>

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

Quality quality(std::span<const std::array<Point2, 3>> triangles);

}  // namespace cutbench
