#include "harness/path/pick.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"

namespace cutbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using DeformedTriangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, DeformedTriangles::const_iterator>;
using Boxes = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(Point3 p) { return {p.x, p.y, p.z}; }
Kernel::Vector_3 vector(Point3 p) { return {p.x, p.y, p.z}; }

/// Weights of the triangle's second and third corner.
struct Weights {
  double second, third;
};

/// Of a point in the triangle's plane.
Weights weights_of(const Kernel::Triangle_3& t, const Kernel::Point_3& p) {
  const auto u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const auto n = CGAL::cross_product(u, v);
  const double n2 = n.squared_length();
  return {n * CGAL::cross_product(w, v) / n2, n * CGAL::cross_product(u, w) / n2};
}

/// Of the point where the line meets the triangle's plane, without the point's own rounding (Moeller and Trumbore,
/// Fast, minimum storage ray/triangle intersection, 1997).
Weights weights_of(const Kernel::Triangle_3& t, const Kernel::Point_3& origin, const Kernel::Vector_3& direction) {
  const auto u = t[1] - t[0], v = t[2] - t[0], s = origin - t[0];
  const auto h = CGAL::cross_product(direction, v), q = CGAL::cross_product(s, u);
  const double determinant = u * h;
  return {s * h / determinant, direction * q / determinant};
}

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", length);
  return text;
}

bool finite(Point3 p) {
  return std::abs(p.x) <= 1e60 && std::abs(p.y) <= 1e60 && std::abs(p.z) <= 1e60;  // NaN is not <= anything
}

/// An edge of the sheet's border.
struct BorderEdge {
  TriangleIndex triangle;
  std::array<Point2, 2> rest;
  std::array<Point3, 2> in_space;
};

double dot(Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

struct Picker::Tree {
  DeformedTriangles deformed;
  std::vector<std::array<Point2, 3>> rest;
  std::vector<TriangleIndex> number;
  Boxes boxes;
  Router router;
  std::vector<BorderEdge> border;  ///< but seams

  explicit Tree(const Sheet& posed) : router(posed) {}

  PlaceAtRest at_rest(DeformedTriangles::const_iterator triangle, Weights w) const {
    const std::size_t place = to_size(triangle - deformed.begin());
    const auto& [a, b, c] = rest[place];
    // Rounding must not carry a pick on the border out of the sheet's triangle.
    const double second = std::clamp(w.second, 0.0, 1.0), third = std::clamp(w.third, 0.0, 1.0 - second);
    const auto& t = *triangle;
    const auto in_space = t[0] + second * (t[1] - t[0]) + third * (t[2] - t[0]);
    return {number[place], a + second * (b - a) + third * (c - a), {in_space.x(), in_space.y(), in_space.z()}};
  }
  /// Of a ray that meets no triangle: it is nearest at an edge, or where it begins.
  double distance(const Kernel::Ray_3& ray) const {
    double best2 = std::numeric_limits<double>::infinity();
    for (const auto& t : deformed) {
      best2 = std::min(best2, CGAL::to_double(CGAL::squared_distance(ray.source(), t)));
      for (int k = 0; k < 3; ++k)
        best2 = std::min(best2, CGAL::to_double(CGAL::squared_distance(ray, Kernel::Segment_3(t[k], t[k + 1]))));
    }
    return std::sqrt(best2);
  }
};

Picker::Picker(const Sheet& posed) : tree_(std::make_unique<Tree>(posed)), mean_edge_(posed.mean_edge()) {
  for (std::size_t i = 0; i < posed.triangle_slots(); ++i) {
    const Triangle& t = posed.triangle(TriangleIndex(i));
    if (!t.alive()) continue;
    const auto at = [&](std::size_t k) { return point(posed.position(t.deformed[k])); };
    const Kernel::Triangle_3 triangle(at(0), at(1), at(2));
    if (triangle.is_degenerate()) continue;  // crumpled to a line: no place in it is one place at rest
    tree_->deformed.push_back(triangle);
    tree_->rest.push_back(posed.corners(TriangleIndex(i)));
    tree_->number.emplace_back(i);
  }
  tree_->boxes.rebuild(tree_->deformed.cbegin(), tree_->deformed.cend());
  add_border(posed);
}

void Picker::add_border(const Sheet& posed) {
  for (const TriangleIndex t : tree_->number)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (!posed.on_border(h) || tree_->router.is_seam(h)) continue;
      const auto& ends = posed.triangle(t).deformed;
      tree_->border.push_back({t,
                               {posed.rest(posed.origin(h)), posed.rest(posed.target(h))},
                               {posed.position(ends[to_size(k)]), posed.position(ends[to_size((k + 1) % 3)])}});
    }
}

PlaceAtRest Picker::on_border_if_near(const PlaceAtRest& place) const {
  PlaceAtRest best = place;
  double least = tolerance * mean_edge_;
  for (const BorderEdge& edge : tree_->border) {
    const auto& [a, b] = edge.in_space;
    const Point3 ab = b + -1.0 * a;
    const double share = std::clamp(dot(place.in_space + -1.0 * a, ab) / dot(ab, ab), 0.0, 1.0);
    const Point3 foot = a + share * ab;
    const double distance = length(place.in_space + -1.0 * foot);
    const Point2 rest = edge.rest[0] + share * (edge.rest[1] - edge.rest[0]);
    // A border that lies upon another part of a folded sheet is near in space alone.
    if (!(distance <= least) || length(rest - place.point) > 4 * tolerance * mean_edge_) continue;
    least = distance;
    best = {edge.triangle, rest, foot};
  }
  return best;
}

Picker::~Picker() = default;

Point2 Picker::rest_point(const Pick& pick, const std::string& name) const { return place(pick, name).point; }

PlaceAtRest Picker::place(const Pick& pick, const std::string& name) const {
  if (tree_->deformed.empty()) throw InputError(name + ": the sheet is crumpled to lines; pick earlier");
  const Kernel::Point_3 origin = point(pick.origin);
  if (!pick.direction) {
    const auto [nearest, triangle] = tree_->boxes.closest_point_and_primitive(origin);
    const double distance = std::sqrt(CGAL::to_double(CGAL::squared_distance(origin, nearest)));
    if (const double most = tolerance * mean_edge_; distance > most)
      throw InputError(name + ": the point misses the sheet by " + metres(distance) + " (at most " + metres(most) +
                       "); give a ray, or a point on the sheet as it then is");
    return tree_->at_rest(triangle, weights_of(*triangle, nearest));
  }
  const Kernel::Vector_3 direction = vector(*pick.direction);
  const Kernel::Ray_3 ray(origin, direction);
  const auto hit = tree_->boxes.first_intersection(ray);
  if (!hit)
    throw InputError(name + ": the ray misses the sheet by " + metres(tree_->distance(ray)) +
                     "; aim at where the sheet then is");
  if (const auto* along = boost::get<Kernel::Segment_3>(&hit->first)) {
    const bool first = CGAL::has_smaller_distance_to_point(origin, along->source(), along->target());
    return tree_->at_rest(hit->second, weights_of(*hit->second, first ? along->source() : along->target()));
  }
  const auto& triangle = *hit->second;
  // In its plane, too, it may meet no more than a corner.
  if (const auto* at = boost::get<Kernel::Point_3>(&hit->first);
      at && CGAL::coplanar(triangle[0], triangle[1], triangle[2], origin))
    return tree_->at_rest(hit->second, weights_of(triangle, *at));
  return tree_->at_rest(hit->second, weights_of(triangle, origin, direction));
}

std::vector<Curve> Picker::rest_curves(const PickedCurve& picked, const std::string& name,
                                       std::vector<HalfEdge>* along) const {
  Curve curve{picked.kind, picked.closed, {}};
  std::vector<PlaceAtRest> places;
  for (std::size_t i = 0; i < picked.picks.size(); ++i) {
    places.push_back(place(picked.picks[i], name + ", point " + std::to_string(i)));
    const bool is_end = !picked.closed && (i == 0 || i + 1 == picked.picks.size());
    if (is_end) places.back() = on_border_if_near(places.back());
    curve.points.push_back(places.back().point);
  }
  const bool is_bezier = curve.kind == Curve::Kind::bezier;
  // Found once is found alike: the first pick again.
  if (curve.closed && is_bezier) curve.points.back() = curve.points.front();
  if (!is_bezier) return tree_->router.route(places, curve.closed, name, along);
  if (!tree_->router.has_seams()) return {curve};
  std::vector<PlaceAtRest> flat = flattened(places);
  if (curve.closed) flat.pop_back();
  std::vector<Curve> curves = tree_->router.route(flat, curve.closed, name + ", flattened", along);
  return curves.size() > 1 ? curves : std::vector{curve};
}

/// A cubic's chords of n equal parts of its parameter are nearer to it than 3/4 of its largest second difference of
/// control points over n^2 (its second derivative is at most 6 of those; a chord's error, 1/8 of that over n^2).
std::vector<PlaceAtRest> Picker::flattened(const std::vector<PlaceAtRest>& control_points) const {
  constexpr double most_parts = 10000;
  std::vector<PlaceAtRest> places{control_points.front()};
  for (std::size_t first = 0; first + 3 < control_points.size(); first += 3) {
    const auto p = [&](std::size_t k) { return control_points[first + k].in_space; };
    const auto bend = [&](std::size_t k) { return length(p(k) + -2.0 * p(k + 1) + p(k + 2)); };
    const double parts = std::sqrt(0.75 * std::max(bend(0), bend(1)) / (flatness * mean_edge_));
    const int n = to_int(std::clamp(std::ceil(parts), 1.0, most_parts));
    for (int i = 1; i < n; ++i) {
      const double t = to_double(i) / n, s = 1 - t;
      const Kernel::Point_3 at =
          point(s * s * s * p(0) + 3 * s * s * t * p(1) + 3 * s * t * t * p(2) + t * t * t * p(3));
      const auto [nearest, triangle] = tree_->boxes.closest_point_and_primitive(at);
      places.push_back(tree_->at_rest(triangle, weights_of(*triangle, nearest)));
    }
    places.push_back(control_points[first + 3]);
  }
  return places;
}

CurvesAtRest curves_at_rest(std::span<const AnyCurve> path, const Sheet& posed, const std::string& name,
                            std::vector<HalfEdge>* along) {
  CurvesAtRest at_rest;
  const auto add = [&](Curve curve, std::size_t cut) {
    at_rest.curves.push_back(std::move(curve));
    at_rest.cut.push_back(cut);
  };
  std::optional<Picker> picker;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string which = name + ", cut " + std::to_string(i);
    if (const auto* curve = std::get_if<Curve>(&path[i])) {
      if (posed.unrolled())
        throw InputError(which + ": the sheet is unrolled, so places at rest mean nothing; give places in space");
      add(*curve, i);
      continue;
    }
    if (!picker) picker.emplace(posed);
    for (const Curve& curve : picker->rest_curves(std::get<PickedCurve>(path[i]), which, along)) add(curve, i);
  }
  return at_rest;
}

void check_picks(const PickedCurve& curve, const std::string& name) {
  // What holds for the points of a curve holds for the places that rays start from.
  for (std::size_t i = 0; i < curve.picks.size(); ++i) {
    const std::string where = name + ", point " + std::to_string(i) + ": ";
    const Pick& pick = curve.picks[i];
    if (!finite(pick.origin) || (pick.direction && !finite(*pick.direction)))
      throw InputError(where + "coordinates must be finite and below 1e60");
    if (pick.direction == Point3{}) throw InputError(where + "the direction is zero; give one, of any length");
  }
  check_curve({curve.kind, curve.closed, std::vector<Point2>(curve.picks.size())}, name);  // enough of them?
  if (curve.kind != Curve::Kind::bezier || !curve.closed) return;
  const Pick &first = curve.picks.front(), &last = curve.picks.back();
  if (first.origin != last.origin || first.direction != last.direction)
    throw InputError(name + ": a closed Bezier must end where it began; repeat its first point at the end");
}

}  // namespace cutbench
