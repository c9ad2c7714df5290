#include "harness/mesh/parents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/mesh/locator.h"

namespace cutbench {

namespace {

/// A crossing is off its edge by its own rounding, and by that of the piece of the edge that a later cut crosses.
constexpr double ulps_off_edge = 4;
/// Halvings of the way to a vertex: as many as doubles have digits.
constexpr int most_halvings = 53;

std::size_t next(std::size_t k) { return to_size(next_corner(to_int(k))); }

constexpr std::array<std::size_t, 3> corners_of_triangle{0, 1, 2};

/// cross(u, v) to two ulp (Kahan's difference of products): in a thin triangle the rounding of the two products counts.
double accurate_cross(Point2 u, Point2 v) {
  const double product = u.y * v.x;
  return std::fma(u.x, v.y, -product) + std::fma(-u.y, v.x, product);
}

struct InTriangle {
  std::array<double, 3> area;      ///< of p and the side opposite each corner, doubled; their sum is the triangle's
  std::array<double, 3> distance;  ///< from that side, below 0 outside
  double rounding;                 ///< what is nearer lies on a side, or at a corner
  bool holds() const { return *std::min_element(distance.begin(), distance.end()) >= -rounding; }
};

InTriangle place_of(Point2 p, const std::array<Point2, 3>& corners) {
  InTriangle place{};
  double largest = 0;
  for (const std::size_t k : corners_of_triangle) {
    const Point2 from = corners[next(k)], to = corners[next(next(k))];
    place.area[k] = accurate_cross(from - p, to - p);
    place.distance[k] = place.area[k] / length(to - from);
    largest = std::max({largest, std::abs(from.x), std::abs(from.y)});
  }
  place.rounding = ulps_off_edge * std::numeric_limits<double>::epsilon() * largest;
  return place;
}

/// The triangle of `before` whose point p is, seen from `inside`, a point of the triangle `start` with no older
/// incision between the two: an old vertex, or a vertex on an old incision, has several places.
TriangleIndex holder(const Sheet& before, TriangleIndex start, Point2 inside, Point2 p) {
  TriangleIndex t = start;
  for (int i = 0; i < most_halvings && !place_of(p, before.corners(t)).holds(); ++i) {
    inside = 0.5 * (inside + p);
    t = triangle_at(before, t, inside);
  }
  return t;
}

/// Of a point on the edge of two vertices; the same from either side of it.
std::vector<VertexPart> parts_on_edge(const Sheet& before, DeformedIndex a, DeformedIndex b, Point2 p) {
  if (b < a) std::swap(a, b);
  const Point2 from = before.rest(before.rest_vertex(a)), along = before.rest(before.rest_vertex(b)) - from;
  const double weight = dot(p - from, along) / squared_length(along);
  return {{a, 1 - weight}, {b, weight}};
}

std::vector<VertexPart> parts_in(const Sheet& before, TriangleIndex t, Point2 p) {
  const auto& corner = before.triangle(t).deformed;
  const auto corners = before.corners(t);
  const InTriangle place = place_of(p, corners);
  for (const std::size_t k : corners_of_triangle)
    if (length(p - corners[k]) <= place.rounding) return {{corner[k], 1}};
  const auto nearer = [&](std::size_t a, std::size_t b) {
    return std::abs(place.distance[a]) < std::abs(place.distance[b]);
  };
  const std::size_t side = *std::min_element(corners_of_triangle.begin(), corners_of_triangle.end(), nearer);
  if (std::abs(place.distance[side]) <= place.rounding)
    return parts_on_edge(before, corner[next(side)], corner[next(next(side))], p);
  const double sum = place.area[0] + place.area[1] + place.area[2];
  std::vector<VertexPart> parts;
  for (const std::size_t k : corners_of_triangle) parts.push_back({corner[k], place.area[k] / sum});
  const auto lighter = [](const VertexPart& a, const VertexPart& b) { return a.weight < b.weight; };
  std::max_element(parts.begin(), parts.end(), lighter)->weight +=
      1 - (parts[0].weight + parts[1].weight + parts[2].weight);
  return parts;
}

Point2 centroid(const std::array<Point2, 3>& c) { return 1.0 / 3 * (c[0] + c[1] + c[2]); }

/// Per slot of a deformed vertex, the triangle at it with the widest corner there: it says where the vertex's side is.
std::vector<TriangleIndex> widest_triangles(const Sheet& cut) {
  std::vector<TriangleIndex> widest(cut.deformed_slots());
  std::vector<double> width(cut.deformed_slots(), -1);  // of the triangle, seen from the vertex
  for (std::size_t t = 0; t < cut.triangle_slots(); ++t) {
    if (!cut.triangle(TriangleIndex(t)).alive()) continue;
    const auto c = cut.corners(TriangleIndex(t));
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 u = c[next(k)] - c[k], v = c[next(next(k))] - c[k];
      const double sine = cross(u, v) / std::sqrt(squared_length(u) * squared_length(v));
      const DeformedIndex d = cut.triangle(TriangleIndex(t)).deformed[k];
      if (sine <= width[d()]) continue;
      width[d()] = sine;
      widest[d()] = TriangleIndex(t);
    }
  }
  return widest;
}

}  // namespace

Parents parents_of(const Sheet& before, const Sheet& cut) {
  const Locator locator(before);
  Parents parents{std::vector<std::vector<VertexPart>>(cut.deformed_slots()),
                  std::vector<TriangleIndex>(cut.triangle_slots())};
  for (std::size_t slot = 0; slot < cut.triangle_slots(); ++slot) {
    const TriangleIndex t(slot);
    if (!cut.triangle(t).alive()) continue;
    const bool is_old = slot < before.triangle_slots() && before.triangle(t).alive();
    const Point2 inside = centroid(cut.corners(t));
    parents.triangles[slot] = triangle_at(before, is_old ? t : locator.near(before, inside), inside);
  }
  const std::vector<TriangleIndex> widest = widest_triangles(cut);
  for (std::size_t slot = 0; slot < cut.deformed_slots(); ++slot) {
    const DeformedIndex d(slot);
    if (!cut.rest_vertex(d).valid()) continue;
    const TriangleIndex beside = widest[slot];
    const Point2 p = cut.rest(cut.rest_vertex(d));
    const TriangleIndex old = holder(before, parents.triangles[beside()], centroid(cut.corners(beside)), p);
    parents.vertices[slot] = parts_in(before, old, p);
  }
  return parents;
}

}  // namespace cutbench
