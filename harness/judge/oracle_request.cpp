#include "harness/judge/oracle_request.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

oracle::Mesh for_oracle(const Sheet& sheet) {
  oracle::Mesh mesh;
  std::vector<int> number(sheet.deformed_slots(), -1);
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const VertexIndex v = sheet.rest_vertex(DeformedIndex(d));
    if (!v.valid()) continue;
    number[d] = to_int(mesh.rest.size());
    mesh.rest.push_back({sheet.rest(v).x, sheet.rest(v).y});
  }
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    if (!triangle.alive()) continue;
    mesh.triangles.push_back(
        {number[triangle.deformed[0]()], number[triangle.deformed[1]()], number[triangle.deformed[2]()]});
  }
  return mesh;
}

oracle::Curve for_oracle(const Curve& cut) {
  oracle::Curve curve{cut.kind == Curve::Kind::bezier, cut.closed, {}};
  for (Point2 p : cut.points) curve.points.push_back({p.x, p.y});
  return curve;
}

namespace {

/// The largest incision error that the bound allows in the sheet, rest units.
double largest_error(const Sheet& sheet, const IncisionBound& bound, const CutOptions& options) {
  double longest2 = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots() && bound.longest_edges > 0; ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto c = sheet.corners(TriangleIndex(t));
    for (std::size_t k = 0; k < 3; ++k) longest2 = std::max(longest2, squared_length(c[(k + 1) % 3] - c[k]));
  }
  // Zero times an infinite tolerance is no number.
  const double traced =
      bound.chord_tolerances > 0 ? bound.chord_tolerances * options.chord_tolerance * sheet.mean_edge() : 0;
  return bound.longest_edges * std::sqrt(longest2) + traced;
}

}  // namespace

oracle::Request request_for(const Sheet& before, std::span<const Curve> cuts, const Promises& promises,
                            const CutOptions& options, bool improved) {
  const double h = before.mean_edge();
  const bool curved =
      std::any_of(cuts.begin(), cuts.end(), [](const Curve& c) { return c.kind == Curve::Kind::bezier; });
  const double flattening = curved ? options.flatten_tolerance * h : 0;
  oracle::Request request;
  request.before = for_oracle(before);
  request.cuts = for_oracle(cuts);
  // A path may pass within `line_tolerance` of what it goes through, and so may the one it meets.
  request.snap = (cuts.size() > 1 ? meeting_tolerance : line_tolerance) * before.snap();
  const double traced = options.chord_tolerance * h + flattening + request.snap;
  request.tolerance = largest_error(before, promises.incision_bound, options) + flattening + request.snap;
  if (curved && std::isfinite(options.chord_tolerance)) request.thin = traced;
  request.keeps_vertices = promises.keeps_vertices;
  request.exact_incision = promises.exact_incision;
  request.keeps_area = promises.keeps_area;
  request.vertex_tolerance = improved ? traced : flattening + request.snap;
  return request;
}

std::vector<oracle::Curve> for_oracle(std::span<const Curve> cuts) {
  std::vector<oracle::Curve> curves;
  for (const Curve& cut : cuts) curves.push_back(for_oracle(cut));
  return curves;
}

}  // namespace cutbench
