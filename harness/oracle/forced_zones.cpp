#include "harness/oracle/forced_zones.h"

#include <limits>
#include <numbers>
#include <optional>

#include "harness/oracle/chains.h"
#include "harness/oracle/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/search.h"

namespace cutbench::oracle {
namespace {

// In units of h, as docs/explanation/measuring.md defines them.
constexpr double wedge_width = 0.3, disc_radius = 0.25, wedge_slack = 0.02;
// Also in units of h: the audit's own resolution.
constexpr double flattening = 1e-5, step = 0.02, leg_test = 0.05, probe = 1e-4, coincidence = 1e-9;

const double forced_angle = std::asin(1.0 / 3.0);

double angle_between(const Point& a, const Point& b) { return std::atan2(cross(a, b), dot(a, b)); }

bool within(const std::vector<Point>& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1])))
      inside = !inside;
  }
  return inside;
}

/// A way to leave a node along a chain.
struct Ray {
  int chain, segment;
  bool forward;
  Point direction;
  double angle;  // of the direction, for sorting
};

class CornerFinder {
 public:
  CornerFinder(const Mesh& before, const std::vector<Curve>& cuts, double h)
      : h_(h), chains_(border_chains(before)), sheet_(before) {
    const std::size_t borders = chains_.size();
    for (Chain& chain : path_chains(cuts, flattening * h)) chains_.push_back(std::move(chain));
    std::vector<Segment> all;
    for (int c = 0; c < to_int(chains_.size()); ++c)
      for (int s = 0; s < to_int(chains_[c].segments.size()); ++s) {
        all.push_back(chains_[c].segments[s].segment);
        owner_.push_back({c, s});
      }
    for (std::size_t c = 0; c < borders; ++c) first_path_ += chains_[c].segments.size();
    for (const Segment& s : all)
      for (const Point& p : s) size_ = std::max({size_, std::abs(p[0]), std::abs(p[1])});
    near_ = std::max(coincidence * h, 16 * std::numeric_limits<double>::epsilon() * size_);
    search_.emplace(std::move(all));
  }

  std::vector<ForcedCorner> run() {
    for (const Segment& s : search_->segments()) {
      visit(s[0]);
      visit(s[1]);
    }
    for (std::size_t i = first_path_; i < search_->segments().size(); ++i) visit_crossings(search_->segments()[i]);
    return std::move(corners_);
  }

 private:
  /// Proper crossings only: all other contacts are at an end point of some segment.
  void visit_crossings(const Segment& s) {
    const BoxTree::Box box{{std::min(s[0][0], s[1][0]), std::min(s[0][1], s[1][1])},
                           {std::max(s[0][0], s[1][0]), std::max(s[0][1], s[1][1])}};
    search_->for_each_in(box, [&](int i) {
      const Segment& o = search_->segments()[i];
      if (orientation(s[0], s[1], o[0]) * orientation(s[0], s[1], o[1]) >= 0) return;
      if (orientation(o[0], o[1], s[0]) * orientation(o[0], o[1], s[1]) >= 0) return;
      const Point along = minus(o[1], o[0]);
      const double begin = cross(along, minus(s[0], o[0])), end = cross(along, minus(s[1], o[0]));
      if (begin != end) visit(between(s[0], s[1], std::clamp(begin / (begin - end), 0.0, 1.0)));
    });
  }

  /// Looks for forced corners between neighbouring rays of a node.
  void visit(const Point& node) {
    const std::vector<Ray> rays = rays_at(node);
    if (rays.size() < 2) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray &a = rays[i], &b = rays[(i + 1) % rays.size()];
      double angle = angle_between(a.direction, b.direction);
      if (angle < 0) angle = angle > -1e-12 ? 0 : angle + 2 * std::numbers::pi;
      if (angle < forced_angle && !known(node, a, angle)) add(node, a, b, angle);
    }
  }

  std::vector<Ray> rays_at(const Point& node) const {
    std::vector<int> found;
    search_->for_each_in({{node[0] - near_, node[1] - near_}, {node[0] + near_, node[1] + near_}}, [&](int i) {
      if (distance(node, search_->segments()[i]) <= near_) found.push_back(i);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<Ray> rays;
    for (int i : found) {
      const auto [chain, index] = owner_[i];
      const PathSegment& s = chains_[chain].segments[index];
      const double before = distance(node, s.segment[0]), after = distance(node, s.segment[1]);
      Point t = between(s.tangent_start, s.tangent_end, before / (before + after));
      const double l = std::hypot(t[0], t[1]);
      t = l > 0 ? Point{t[0] / l, t[1] / l} : s.tangent_start;
      if (after > 2 * near_) rays.push_back({chain, index, true, t, std::atan2(t[1], t[0])});
      if (before > 2 * near_) rays.push_back({chain, index, false, {-t[0], -t[1]}, std::atan2(-t[1], -t[0])});
    }
    std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.angle < b.angle; });
    return rays;
  }

  /// The same corner is met at each end point and crossing that lies on it; two nearly parallel legs make it long.
  bool known(const Point& node, const Ray& a, double angle) const {
    const double reach = 4 * near_ / std::max(angle, 1e-8), turn = 0.1 * angle + 1e-6;
    return std::any_of(corners_.begin(), corners_.end(), [&](const ForcedCorner& c) {
      return distance(c.apex, node) <= reach && std::abs(angle_between(c.leg1, a.direction)) <= turn &&
             std::abs(c.angle - angle) <= turn;
    });
  }

  /// Adds the corner, unless its legs are one leg or enclose nothing of the sheet.
  void add(const Point& node, const Ray& a, const Ray& b, double angle) {
    if (gap(node, a, b, leg_test).width <= near_ || !sheet_.holds(gap(node, a, b, probe).middle)) return;
    const bool curved = chains_[a.chain].curved || chains_[b.chain].curved;
    const double slack = curved ? std::min(0.1, 2e-3 / std::max(std::sin(angle), 1e-3)) : 1e-6;
    corners_.push_back({node, a.direction, b.direction, angle, wedge(node, a, b), std::max(slack * h_, near_)});
  }

  struct Gap {
    Point middle;
    double width;
  };

  /// Between the two legs, both followed for the given length (in h) or until one ends.
  Gap gap(const Point& node, const Ray& a, const Ray& b, double length) const {
    Walker left = walker(a, node), right = walker(b, node);
    advance(left, right, length * h_);
    return {between(left.position(), right.position(), 0.5), distance(left.position(), right.position())};
  }

  /// The polygon between the legs, followed while they are close.
  std::vector<Point> wedge(const Point& node, const Ray& a, const Ray& b) const {
    Walker left = walker(a, node), right = walker(b, node);
    std::vector<Point> polygon{node}, back;
    while (advance(left, right, step * h_) && distance(left.position(), right.position()) < wedge_width * h_) {
      polygon.push_back(left.position());
      back.push_back(right.position());
    }
    polygon.insert(polygon.end(), back.rbegin(), back.rend());
    return polygon;
  }

  Walker walker(const Ray& ray, const Point& node) const {
    return {chains_[ray.chain], ray.segment, ray.forward, node};
  }

  /// Both equally far, at most `length`; false where one could not move at all.
  static bool advance(Walker& left, Walker& right, double length) {
    const double reach = std::min(Walker(left).advance(length), Walker(right).advance(length));
    left.advance(reach);
    right.advance(reach);
    return reach > 1e-6 * length;
  }

  double h_;
  std::vector<Chain> chains_;
  TriangleSearch sheet_;
  std::vector<std::pair<int, int>> owner_;  // chain and segment of each segment that is searched
  std::size_t first_path_ = 0;              // segments before this one are border
  std::optional<SegmentSearch> search_;
  double size_ = 0;  // largest coordinate
  double near_ = 0;  // points nearer than this are one
  std::vector<ForcedCorner> corners_;
};

bool lies_near(const std::vector<Point>& polygon, const Point& p, double slack) {
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    if (distance(p, Segment{polygon[j], polygon[i]}) <= slack) return true;
  return false;
}

/// From the apex to the farthest point of its wedge.
double reach_of(const ForcedCorner& corner) {
  double reach = 0;
  for (const Point& p : corner.wedge) reach = std::max(reach, distance(p, corner.apex));
  return reach;
}

/// Whether the triangle has the apex as a vertex and lies between the legs.
bool fills_corner(const ForcedCorner& corner, const std::array<Point, 3>& triangle, const Point& centroid) {
  for (const Point& p : triangle) {
    if (distance(p, corner.apex) > corner.apex_tolerance) continue;
    const Point d = minus(centroid, p);
    const bool between_legs = cross(corner.leg1, d) >= 0 && cross(d, corner.leg2) >= 0 && dot(corner.leg1, d) > 0;
    if (between_legs || within(corner.wedge, centroid)) return true;
  }
  return false;
}

}  // namespace

std::vector<ForcedCorner> forced_corners(const Mesh& before, const std::vector<Curve>& cuts, double h) {
  return CornerFinder(before, cuts, h).run();
}

ForcedZones forced_zones(const std::vector<ForcedCorner>& corners, const Mesh& after, double h) {
  const std::size_t count = after.triangles.size();
  const std::vector<char> none(count, 0);
  ForcedZones zones{none, none, none};
  std::vector<double> reach;
  for (const ForcedCorner& corner : corners)
    reach.push_back(std::max(reach_of(corner) + wedge_slack * h, disc_radius * h));
  for (std::size_t t = 0; t < count; ++t) {
    const auto& [i, j, k] = after.triangles[t];
    const Point &a = after.rest[i], &b = after.rest[j], &c = after.rest[k];
    const Point centroid{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
    for (std::size_t w = 0; w < corners.size(); ++w) {
      const ForcedCorner& corner = corners[w];
      if (fills_corner(corner, {a, b, c}, centroid)) zones.in_corner[t] = zones.in_zone[t] = 1;
      const double far = distance(centroid, corner.apex);
      if (far > reach[w]) continue;
      if (far < disc_radius * h || within(corner.wedge, centroid)) zones.in_zone[t] = 1;
      if (lies_near(corner.wedge, centroid, wedge_slack * h)) zones.near_zone[t] = 1;
    }
    if (zones.in_zone[t]) zones.near_zone[t] = 1;
    const double area = cross(minus(b, a), minus(c, a)) / 2;
    zones.corner_triangles += zones.in_corner[t];
    zones.zone_triangles += zones.in_zone[t];
    if (zones.in_corner[t]) zones.corner_area += area;
    if (zones.in_zone[t]) zones.zone_area += area;
  }
  return zones;
}

}  // namespace cutbench::oracle
