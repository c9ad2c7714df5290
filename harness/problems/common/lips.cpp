#include "harness/problems/common/lips.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

struct OpenedEdge {
  Point2 from, to;
  TriangleIndex left, right;
  Eigen::Vector2d jump_from, jump_to;  ///< of the left lip relative to the right one, m
};

std::vector<OpenedEdge> opened_edges(const Sheet& sheet, const Field& displacement) {
  std::vector<OpenedEdge> edges;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const TriangleIndex slot(t);
    if (!sheet.triangle(slot).alive()) continue;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(slot, k), o = sheet.opposite(h);
      if (sheet.mark(h) != EdgeMark::incision || o < h) continue;
      const auto moved = [&](HalfEdge lip, int end) -> Eigen::Vector2d {
        const int corner = end == 0 ? corner_of(lip) : next_corner(corner_of(lip));
        return displacement.segment<2>(2 * sheet.triangle(triangle_of(lip)).deformed[to_size(corner)].value);
      };
      edges.push_back({sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h)), triangle_of(h), triangle_of(o),
                       moved(h, 0) - moved(o, 1), moved(h, 1) - moved(o, 0)});
    }
  }
  return edges;
}

}  // namespace

std::vector<double> opening(const Sheet& sheet, const Field& displacement, const std::vector<LipSample>& samples,
                            double reach, const TipFunctions* functions, const Eigen::VectorXd& of_tips) {
  const std::vector<OpenedEdge> edges = opened_edges(sheet, displacement);
  std::vector<double> gapes;
  for (const LipSample& sample : samples) {
    double nearest = reach * reach, gape = 0;
    for (const OpenedEdge& edge : edges) {
      const Point2 along = edge.to - edge.from;
      const double s = std::clamp(dot(sample.at - edge.from, along) / squared_length(along), 0.0, 1.0);
      const double distance = squared_length(edge.from + s * along - sample.at);
      if (distance > nearest) continue;
      nearest = distance;
      const double sign = cross(along, sample.normal) > 0 ? 1 : -1;
      Eigen::Vector2d jump = (1 - s) * edge.jump_from + s * edge.jump_to;
      if (of_tips.size() > 0) {
        const Point2 p = edge.from + s * along;
        jump += functions->displacement(edge.left, p, of_tips).value;
        jump -= functions->displacement(edge.right, p, of_tips).value;
      }
      gape = sign * jump.dot(Eigen::Vector2d(sample.normal.x, sample.normal.y));
    }
    gapes.push_back(gape);
  }
  return gapes;
}

std::vector<double> opening(const ElasticField& field, const std::vector<LipSample>& samples) {
  std::vector<double> gapes;
  for (const auto& [at, normal, length] : samples)
    gapes.push_back((field.displacement(at, at + 1e-3 * normal) - field.displacement(at, at + -1e-3 * normal))
                        .dot(Eigen::Vector2d(normal.x, normal.y)));
  return gapes;
}

double opening_error(const std::vector<LipSample>& samples, const std::vector<double>& found,
                     const std::vector<double>& exact) {
  double off = 0, scale = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    off += samples[i].length * std::pow(found[i] - exact[i], 2);
    scale += samples[i].length * std::pow(exact[i], 2);
  }
  return std::sqrt(off / scale);
}

}  // namespace cutbench
