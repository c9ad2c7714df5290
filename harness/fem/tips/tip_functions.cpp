#include "harness/fem/tips/tip_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

constexpr double just_short_of = 0.99;  // of the next tip or border

double distance(Point2 p, Point2 a, Point2 b) {
  const Point2 along = b - a;
  const double s = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
  return std::sqrt(squared_length(a + s * along - p));
}

template <class Visit>
void for_each_half_edge(const Sheet& sheet, Visit visit) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive())
      for (int k = 0; k < 3; ++k) visit(half_edge(TriangleIndex(t), k));
}

/// The angle at the tip from a to b, the ends of a segment that does not meet it: its sign is exact.
double turn(Point2 tip, Point2 a, Point2 b) {
  const double size = std::atan2(std::abs(cross(a - tip, b - tip)), dot(a - tip, b - tip));
  return orientation(tip, a, b) * size;
}

struct CutOff {
  double value, slope;  ///< chi, d chi / d r
};

CutOff cut_off(double r, double radius) {
  const double s = r / radius;
  if (s >= 1) return {0, 0};
  return {(1 - s) * (1 - s), -2 * (1 - s) / radius};
}

}  // namespace

TipFunctions::TipFunctions(const Sheet& sheet) : sheet_(sheet), reaching_(sheet.triangle_slots()) {
  std::vector<std::uint8_t> ends(sheet.vertex_slots()), on_border(sheet.vertex_slots());  // ends of opened edges
  std::vector<HalfEdge> border, opened(sheet.vertex_slots());
  for_each_half_edge(sheet, [&](HalfEdge h) {
    const std::size_t from = sheet.origin(h)();
    if (sheet.on_border(h)) {
      border.push_back(h);
      on_border[from] = on_border[sheet.target(h)()] = 1;
    } else if (sheet.mark(h) == EdgeMark::incision) {
      ends[from] = static_cast<std::uint8_t>(std::min(ends[from] + 1, 3));
      opened[from] = h;
    }
  });
  const auto is_tip = [&](std::size_t v) { return ends[v] == 1 && !on_border[v]; };
  for (std::size_t v = 0; v < ends.size(); ++v) {
    if (!is_tip(v)) continue;
    const Point2 at = sheet.rest(VertexIndex(v));
    double nearest = std::numeric_limits<double>::infinity();
    for (const HalfEdge h : border)
      nearest = std::min(nearest, distance(at, sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h))));
    for (std::size_t other = 0; other < ends.size(); ++other)
      if (other != v && ends[other] % 2 == 1)  // an end or a branching
        nearest = std::min(nearest, std::sqrt(squared_length(sheet.rest(VertexIndex(other)) - at)));
    if (just_short_of * nearest < sheet.mean_edge()) continue;
    tips_.push_back({VertexIndex(v), at, just_short_of * nearest});
    reach_from(tips_.size() - 1, opened[v]);
  }
}

/// From the lip on the left of the incision, seen from the tip.
void TipFunctions::reach_from(std::size_t tip, HalfEdge incision) {
  const VertexIndex vertex = tips_[tip].vertex;
  const Point2 at = tips_[tip].at;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<TriangleIndex> all;
  const auto is_reached = [&](TriangleIndex t) { return !reaching_[t()].empty() && reaching_[t()].back().tip == tip; };
  const auto enter = [&](HalfEdge h, double at_origin, double at_target) {
    const TriangleIndex t = triangle_of(h);
    const auto a = to_size(corner_of(h)), b = (a + 1) % 3, c = (a + 2) % 3;
    const auto corners = sheet_.corners(t);
    auto& theta = reaching_[t()].emplace_back(Reach{tip, {}}).theta;
    theta[a] = at_origin;
    theta[b] = at_target;
    theta[c] = sheet_.triangle(t).vertex[c] == vertex ? nothing
               : std::isnan(at_origin)                ? at_target + turn(at, corners[b], corners[c])
                                                      : at_origin + turn(at, corners[a], corners[c]);
    all.push_back(t);
  };
  enter(incision, nothing, -std::numbers::pi);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(all[i], k), across = sheet_.opposite(h);
      if (sheet_.separates(h) || is_reached(triangle_of(across)) ||
          distance(at, sheet_.rest(sheet_.origin(h)), sheet_.rest(sheet_.target(h))) >= tips_[tip].radius)
        continue;
      const auto theta = reaching_[all[i]()].back().theta;
      enter(across, theta[to_size(next_corner(k))], theta[to_size(k)]);
    }
}

std::array<TipFunctions::Value, TipFunctions::per_tip> TipFunctions::at(TriangleIndex t, const Reach& reach,
                                                                        Point2 p) const {
  const auto& [vertex, at, radius] = tips_[reach.tip];
  const Point2 from_tip = p - at;
  const double r = std::sqrt(squared_length(from_tip));
  const std::size_t k = std::isnan(reach.theta[0]) ? 1 : 0;
  double least = reach.theta[k], most = least;
  for (const double theta : reach.theta)
    if (!std::isnan(theta)) {
      least = std::min(least, theta);
      most = std::max(most, theta);
    }
  const Point2 corner = sheet_.corners(t)[k] - at;
  // Within the corners' range, rounded points of slivers keep to their side of the incision.
  const double theta =
      std::clamp(reach.theta[k] + std::atan2(cross(corner, from_tip), dot(corner, from_tip)), least, most);
  const double root = std::sqrt(r), s = std::sin(theta / 2), c = std::cos(theta / 2), sine = std::sin(theta),
               cosine = std::cos(theta);
  const std::array<double, per_tip> f{s, c, s * sine, c * sine},
      slope{c / 2, -s / 2, c / 2 * sine + s * cosine, -s / 2 * sine + c * cosine};
  const Eigen::Vector2d outward(from_tip.x / r, from_tip.y / r), around(-outward.y(), outward.x());
  const CutOff chi = cut_off(r, radius);
  std::array<Value, per_tip> values;
  for (std::size_t j = 0; j < per_tip; ++j) {
    values[j].value = chi.value * root * f[j];
    values[j].gradient =
        (chi.value / (2 * root) + chi.slope * root) * f[j] * outward + chi.value / root * slope[j] * around;
  }
  return values;
}

TipFunctions::Displacement TipFunctions::displacement(TriangleIndex t, Point2 p, const Eigen::VectorXd& c) const {
  Displacement sum;
  for (const Reach& reach : reaching(t)) {
    if (p == tips_[reach.tip].at) continue;
    const auto values = at(t, reach, p);
    for (std::size_t j = 0; j < per_tip; ++j) {
      const Eigen::Vector2d of_function = c.segment<2>(to_index(2 * (per_tip * reach.tip + j)));
      sum.value += values[j].value * of_function;
      sum.gradient += of_function * values[j].gradient.transpose();
    }
  }
  return sum;
}

}  // namespace cutbench
