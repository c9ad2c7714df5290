#include "harness/simulation/active_region.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness/base/errors.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

/// By the even-odd rule; an open line ends where it began, by its chord.
bool is_inside(Point2 p, const Polyline& line) {
  bool inside = false;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Point2 a = line.points[i], b = line.points[(i + 1) % line.points.size()];
    if ((a.y <= p.y) != (b.y <= p.y)) inside ^= orientation(a, b, p) == (a.y <= p.y ? 1 : -1);
  }
  return inside;
}

bool is_near(Point2 p, const Polyline& line, double radius) {
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
    if (squared_distance(p, line.points[i], line.points[(i + 1) % line.points.size()]) <= radius * radius) return true;
  return is_inside(p, line);
}

/// Per rest vertex.
std::vector<std::uint8_t> vertices_near(const Sheet& sheet, std::span<const Curve> curves, double radius) {
  std::vector<std::uint8_t> near(sheet.vertex_slots());
  Polyline line;
  for (const Curve& curve : curves) {
    flatten(curve, 0.01 * radius, sheet.snap(), line);
    for (std::size_t v = 0; v < near.size(); ++v)
      if (!near[v] && sheet.triangle_of_vertex(VertexIndex(v)).valid())
        near[v] = is_near(sheet.rest(VertexIndex(v)), line, radius);
  }
  return near;
}

double longest_edge(const Sheet& sheet) {
  double longest2 = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto p = sheet.corners(TriangleIndex(t));
    for (std::size_t k = 0; k < 3; ++k) longest2 = std::max(longest2, squared_length(p[(k + 1) % 3] - p[k]));
  }
  return std::sqrt(longest2);
}

}  // namespace

void check_radius_spans_edges(const Sheet& sheet, double radius, const std::string& name) {
  if (std::isinf(radius)) return;
  const double longest = longest_edge(sheet);
  if (radius >= longest) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      ": \"active_radius\" %.3g m is less than the longest edge, %.3g m; make it larger, or the triangles smaller",
      radius, longest);
  throw InputError(name + text);
}

ActiveRegion active_region(const Sheet& sheet, std::span<const Curve> curves, double radius) {
  const std::vector<std::uint8_t> near = vertices_near(sheet, curves, radius);
  const auto kept_by = [&](const std::vector<std::uint8_t>& vertices, std::size_t t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    const auto is_in = [&](VertexIndex v) { return vertices[v()] != 0; };
    return triangle.alive() && std::any_of(triangle.vertex.begin(), triangle.vertex.end(), is_in);
  };
  std::vector<std::uint8_t> kept = near;  // and then with one ring, and two
  for (int ring = 0; ring < 2; ++ring) {
    const std::vector<std::uint8_t> inner = kept;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      if (kept_by(inner, t))
        for (const VertexIndex v : sheet.triangle(TriangleIndex(t)).vertex) kept[v()] = 1;
  }
  ActiveRegion region;
  if (std::find(near.begin(), near.end(), 1) == near.end()) return region;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    const auto is_kept = [&](VertexIndex v) { return kept[v()] != 0; };
    if (triangle.alive() && !std::all_of(triangle.vertex.begin(), triangle.vertex.end(), is_kept))
      region.outside.push_back(TriangleIndex(t));
  }
  for (std::size_t v = 0; v < near.size(); ++v) {
    const Point2 p = sheet.rest(VertexIndex(v));
    if (kept[v] && !near[v]) region.pins.push_back({.where = {p, p}});
  }
  return region;
}

}  // namespace cutbench
