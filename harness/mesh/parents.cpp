#include "harness/mesh/parents.h"

#include <algorithm>
#include <array>
#include <limits>

namespace cutbench {

namespace {

/// The smallest barycentric coordinate of p: below 0 outside.
double depth_in(const std::array<Point2, 3>& corners, Point2 p) {
  const auto [a, b, c] = corners;
  const double area2 = cross(b - a, c - a);
  return std::min({cross(b - a, p - a), cross(c - b, p - b), cross(a - c, p - c)}) / area2;
}

void add_part(std::vector<VertexPart>& parts, const VertexPart& more) {
  const auto same = [&](const VertexPart& part) { return part.vertex == more.vertex; };
  const auto known = std::find_if(parts.begin(), parts.end(), same);
  if (known == parts.end())
    parts.push_back(more);
  else
    known->weight += more.weight;
}

}  // namespace

std::vector<std::vector<VertexPart>> vertex_parents(const Sheet& cut) {
  std::vector<std::vector<VertexPart>> parents(cut.deformed_slots());
  for (std::size_t d = 0; d < cut.log().deformed_before; ++d) parents[d] = {{DeformedIndex(d), 1}};
  for (const EditLog::Ancestry& made : cut.log().ancestry) {  // parents come before children
    std::vector<VertexPart> parts;
    for (std::size_t i = 0; i < 3 && made.parents[i].valid(); ++i)
      for (const VertexPart& part : parents[made.parents[i]()])
        add_part(parts, {part.vertex, made.weights[i] * part.weight});
    parents[made.vertex()] = std::move(parts);
  }
  for (std::size_t d = 0; d < parents.size(); ++d)
    if (!cut.rest_vertex(DeformedIndex(d)).valid()) parents[d].clear();
  return parents;
}

std::vector<TriangleIndex> triangle_parents(const Sheet& before, const Sheet& cut) {
  std::vector<TriangleIndex> parents(cut.triangle_slots());
  std::vector<TriangleIndex> replaced;
  std::vector<bool> changed(cut.triangle_slots(), true);
  for (std::size_t t = 0; t < cut.log().triangles_before; ++t) changed[t] = false;
  for (const EditLog::Touched& touched : cut.log().touched) {
    changed[touched.slot()] = true;
    if (before.triangle(touched.slot).alive()) replaced.push_back(touched.slot);
  }
  for (std::size_t t = 0; t < parents.size(); ++t) {
    if (!cut.triangle(TriangleIndex(t)).alive()) continue;
    if (!changed[t]) {
      parents[t] = TriangleIndex(t);
      continue;
    }
    const auto [a, b, c] = cut.corners(TriangleIndex(t));
    const Point2 centroid = (1.0 / 3) * (a + b + c);
    double deepest = -std::numeric_limits<double>::infinity();
    for (const TriangleIndex old : replaced) {
      const double depth = depth_in(before.corners(old), centroid);
      if (depth <= deepest) continue;
      deepest = depth;
      parents[t] = old;
    }
  }
  return parents;
}

}  // namespace cutbench
