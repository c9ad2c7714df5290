// Positions: in the plane of the undeformed sheet, and in the space of the deformed one.
#pragma once

#include <cmath>

namespace cutbench {

/// A position in rest space: the plane of the undeformed sheet.
struct Point2 {
  double x = 0, y = 0;
  constexpr bool operator==(const Point2&) const = default;
};

/// A position of the deformed sheet.
struct Point3 {
  double x = 0, y = 0, z = 0;
  constexpr bool operator==(const Point3&) const = default;
};

constexpr Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }
constexpr double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
constexpr double squared_length(Point2 a) { return dot(a, a); }
inline double length(Point2 a) { return std::sqrt(squared_length(a)); }

constexpr Point3 operator+(Point3 a, Point3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point3 operator*(double s, Point3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double length(Point3 a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

}  // namespace cutbench
